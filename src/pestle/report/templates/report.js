document.querySelectorAll("[data-film]").forEach(function (film) {
  var stills = film.querySelectorAll("img"), range = film.querySelector("input");
  var label = film.querySelector("output"), play = film.querySelector("[data-play]"), timer = 0;
  function show() {
    stills.forEach(function (img, n) { img.classList.toggle("on", n === +range.value); });
    label.textContent = stills[range.value].dataset.label;
  }
  function stop() { clearInterval(timer); timer = 0; play.textContent = "▶"; }
  range.addEventListener("input", function () { stop(); show(); });
  play.addEventListener("click", function () {
    if (timer) { stop(); return; }
    if (range.value === range.max) { range.value = 0; }
    play.textContent = "❚❚";
    timer = setInterval(function () {
      if (range.value === range.max) { stop(); return; }
      range.value = +range.value + 1;
      show();
    }, 220);
  });
  show();
});

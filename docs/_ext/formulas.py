"""Formulas as inline SVG, set by matplotlib when the pages are built.

They need neither script, network nor a font of the reader's, and take the colour of the
text around them. A formula that cannot be set is a warning, so the build fails.
"""

import re
from functools import cache
from html import escape
from typing import Any

import matplotlib as mpl
from docutils import nodes
from matplotlib.font_manager import FontProperties
from matplotlib.path import Path
from matplotlib.textpath import TextToPath
from sphinx.application import Sphinx
from sphinx.util import logging

_SIZE = 10.0  # of the font while setting; the result is in units of it
_ZOOM = 1.12  # of formulas against text
_LETTERS = {Path.MOVETO: "M", Path.LINETO: "L", Path.CURVE3: "Q", Path.CURVE4: "C"}
_POINTS = {Path.MOVETO: 1, Path.LINETO: 1, Path.CURVE3: 2, Path.CURVE4: 3}
_TOKEN = re.compile(r"\s*(\\[A-Za-z]+|\\.|[^\s])")
_OTHER = {
    "tfrac": r"\frac",
    "le": r"\leq",
    "ge": r"\geq",
    "lvert": r"\vert",
    "rvert": r"\vert",
}
"""Commands of TeX that matplotlib knows under another name."""
_ARGUMENTS = {r"\frac": 2, r"\dfrac": 2, r"\sqrt": 1, r"\mathbf": 1}
_log = logging.getLogger(__name__)


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the renderer under the name of `html_math_renderer`."""
    app.add_html_math_renderer("svg", (visit_inline, None), (visit_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def visit_inline(writer: Any, node: nodes.math) -> None:
    """Write a formula in a line."""
    writer.body.append(_svg(node.astext(), node))
    raise nodes.SkipNode


def visit_block(writer: Any, node: nodes.math_block) -> None:
    """Write a formula of its own, one line of it below the other."""
    writer.body.append(writer.starttag(node, "div", CLASS="math"))
    for line in re.split(r"\\\\", node.astext()):
        tall = re.sub(r"\\frac(?![A-Za-z])", r"\\dfrac", line.replace("&", " "))
        writer.body.append(f"<div>{_svg(tall, node)}</div>")
    writer.body.append("</div>\n")
    raise nodes.SkipNode


def _svg(tex: str, node: nodes.Node) -> str:
    clean = " ".join(tex.split())
    try:
        width, height, depth, outline = _set(braced(clean))
    except ValueError as error:
        problem = str(error).splitlines()[-1]
        _log.warning("formula %r: %s", clean, problem, location=node)
        return f"<code>{escape(clean)}</code>"
    em = _ZOOM / _SIZE
    box = f"0 {depth - height:.2f} {width:.2f} {height:.2f}"
    return (
        f'<svg class="formula" role="img" aria-label="{escape(clean)}" viewBox="{box}" '
        f'style="width:{width * em:.3f}em;height:{height * em:.3f}em;'
        f'vertical-align:{-depth * em:.3f}em">'
        f'<path fill="currentColor" d="{outline}"/></svg>'
    )


def is_formula(tex: str) -> bool:
    """Tell whether a formula can be set."""
    try:
        _set(tex)
    except ValueError:
        return False
    return True


@cache
def _set(tex: str) -> tuple[float, float, float, str]:
    """Width, height, depth and outline of a formula; y points down in the outline."""
    with mpl.rc_context({"mathtext.fontset": "stix"}):
        setter, font, text = TextToPath(), FontProperties(size=_SIZE), f"${tex}$"
        width, height, depth = setter.get_text_width_height_descent(text, font, True)
        points, codes = setter.get_text_path(font, text, ismath=True)
    scale = _SIZE / setter.FONT_SCALE
    return width + 0.3, height + 0.4, depth + 0.2, _outline(points, codes, scale)


def _outline(points: Any, codes: Any, scale: float) -> str:
    parts, n = [], 0
    while n < len(codes):
        code = codes[n]
        if code == Path.CLOSEPOLY:
            parts.append("Z")
            n += 1
            continue
        count = _POINTS[code]
        rows = [f"{x * scale:.2f} {-y * scale:.2f}" for x, y in points[n : n + count]]
        parts.append(_LETTERS[code] + " ".join(rows))
        n += count
    return "".join(parts)


def braced(tex: str) -> str:
    r"""Write out what TeX allows to leave away: ``\tfrac43`` as ``\frac{4}{3}``."""
    tex = re.sub(r"\\[bB]igg?(?![A-Za-z])", "", tex)  # sizes are not known there
    tex = re.sub(r"\\mathrel\{([^{}]*)\}", r"{\1}", tex)
    tex = re.sub(r"\\([A-Za-z]+)", lambda match: _OTHER.get(match[1], match[0]), tex)
    tex = tex.replace("^*", "^{*}")  # without the space around an operator
    for name, arguments in _ARGUMENTS.items():
        done, rest = "", tex
        while name in rest:
            before, _, rest = rest.partition(name)
            done += before + name
            for _ in range(arguments):
                token = _TOKEN.match(rest)
                if token is None or token[1] in "{[":
                    group = _group(rest)
                    done, rest = done + rest[:group], rest[group:]
                else:
                    done, rest = f"{done}{{{token[1]}}}", rest[token.end() :]
        tex = done + rest
    return tex


def _group(text: str) -> int:
    """Length of the group in braces that a text begins with."""
    depth = 0
    for place, letter in enumerate(text):
        depth += {"{": 1, "}": -1}.get(letter, 0)
        if depth == 0 and letter == "}":
            return place + 1
    return len(text)

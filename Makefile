# Both targets work in a fresh clone: they need make and Python 3.11 or newer.
PYTHON ?= python3
BIN = .venv/bin
DEMO = runs/tablet

.PHONY: demo test docs clean

demo: .venv/installed
	$(BIN)/pestle run examples/tablet.toml --out $(DEMO) --overwrite
	@echo "The report is in $(CURDIR)/$(DEMO)/report.html: open it in a browser."

test: .venv/installed-for-tests
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	@if [ -f docs/conf.py ]; then $(MAKE) --no-print-directory docs; fi
	$(BIN)/pytest -n logical --dist loadfile

docs: .venv/installed-for-tests
	$(BIN)/sphinx-build -W --keep-going -q -b html docs docs/_build/html
	@echo "The documentation is in $(CURDIR)/docs/_build/html/index.html"

clean:
	rm -rf .venv docs/_build .mypy_cache .pytest_cache .ruff_cache

.venv/bin/python:
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "pestle needs Python 3.11 or newer; try: make PYTHON=python3.12")'
	$(PYTHON) -m venv .venv
	$(BIN)/python -m pip install --quiet --upgrade pip

.venv/installed: .venv/bin/python pyproject.toml
	$(BIN)/python -m pip install --quiet --editable .
	@touch $@

.venv/installed-for-tests: .venv/bin/python pyproject.toml
	$(BIN)/python -m pip install --quiet --editable ".[test,docs]"
	@touch $@ .venv/installed

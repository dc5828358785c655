"""Sphinx configuration: MyST pages, reference pages generated from the source."""

import sys
from importlib.metadata import version as version_of
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

project = "pestle"
author = "The pestle developers"
copyright = author
version = release = version_of("pestle")

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "generated",
    "formulas",
]
exclude_patterns = ["_build", "_generated", "_ext"]
source_suffix = {".md": "markdown"}

myst_enable_extensions = ["attrs_inline", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 4
myst_links_external_new_tab = False

autodoc_member_order = "bysource"
autodoc_typehints = "none"
napoleon_google_docstring = False
napoleon_use_rtype = False

default_role = "code"
smartquotes = False  # they would turn --set into a dash
pygments_style = "friendly"
pygments_dark_style = "monokai"
html_theme = "furo"
html_title = f"pestle {release}"
html_static_path = ["_static"]
html_css_files = ["pestle.css"]
html_math_renderer = "svg"
html_copy_source = False
html_show_sphinx = False
nitpicky = False

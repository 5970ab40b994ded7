"""Sphinx's configuration of the documentation, which scripts/docs builds.

scripts/docs puts this folder, the pages of docs/ and generated pages side by side.
"""

import importlib.util
import os
import re
from pathlib import Path

checkout = Path(os.environ["DOCS_CHECKOUT"])
manifest = (checkout / "package.xml").read_text(encoding="utf-8")

project = "deformable_manipulation"
author = "Deformable Manipulation Maintainers"
copyright = author
release = re.search(r"<version>(.*)</version>", manifest).group(1)

extensions = [
    "breathe",
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.mathjax",
    "sphinx.ext.napoleon",
    "sphinx.ext.viewcode",
    "sphinxcontrib.mermaid",
]
html_theme = "furo"
html_title = f"{project} {release}"
html_show_sphinx = False
# Formulas show without a network. Only the files of the package are taken: as an extension it would
# keep Sphinx from reading pages in parallel.
mathjax = Path(importlib.util.find_spec("sphinx-mathjax-offline").origin).parent
html_static_path = [str(mathjax / "static")]
mathjax_path = "mathjax/tex-chtml.js"

# As code hosts read Markdown: mermaid in fences, $...$ and $$...$$, links to headings.
myst_enable_extensions = ["dollarmath", "html_image"]
myst_fence_as_directive = ["math", "mermaid"]
myst_heading_anchors = 4

napoleon_numpy_docstring = False
napoleon_use_ivar = True  # attributes that a docstring lists are no members of their own
autodoc_member_order = "bysource"
autodoc_default_options = {"members": True, "undoc-members": True, "show-inheritance": True}
# Names that a package offers beside the module that has them are two targets of one thing.
suppress_warnings = ["ref.python"]

breathe_projects = {project: os.environ["DOCS_DOXYGEN_XML"]}
breathe_default_project = project
breathe_default_members = ("members", "undoc-members")

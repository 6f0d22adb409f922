"""Sphinx over the pages of the repository as they stand; tools/site.py calls it."""

import os
import pathlib
import re
import sys

from docutils import nodes

HERE = pathlib.Path(__file__).parent
sys.path[:0] = [str(HERE), os.environ["TROCHOID_MODULE"]]  # the built Python module

project = "Trochoid"
copyright = "the authors of Trochoid"
release = os.environ.get("TROCHOID_VERSION", "")
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon",
              "breathe", "katex"]
root_doc = "index"
exclude_patterns = []

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
myst_dmath_double_inline = True
myst_update_mathjax = False

html_theme = "furo"
html_title = "Trochoid"
html_static_path = [str(HERE / "static")]
html_css_files = ["site.css"]
html_copy_source = False
html_show_sphinx = False
html_math_renderer = "katex"
pygments_style = "tango"
pygments_dark_style = "monokai"

autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings say them, with shapes and units
autodoc_preserve_defaults = True

breathe_projects = {"trochoid": os.environ["TROCHOID_DOXYGEN"]}
breathe_default_project = "trochoid"
breathe_default_members = ("members", "undoc-members")
cpp_id_attributes = []


def link_to_folder(app, docname, source):
    """In a git viewer a link to a folder shows its README; here it leads to that page."""
    page = pathlib.Path(app.srcdir, docname).parent

    def readme(link):
        if (page / link[1]).is_dir() and (page / link[1] / "README.md").is_file():
            return f"]({link[1].rstrip('/')}/README.md)"
        return link[0]

    source[0] = re.sub(r"\]\(([\w./-]+)\)", readme, source[0])


def as_it_stands(app, what, name, of, options, lines, kept={}):
    """Napoleon takes what stands before a colon for a type, in docstrings of properties."""
    if what == "property":
        if name in kept:
            lines[:] = kept.pop(name)
        else:
            kept[name] = list(lines)


def place_is_no_link(app, doctree):
    """Doxygen takes file:line:col for an address."""
    for link in list(doctree.findall(nodes.reference)):
        if link.get("refuri", "").startswith("file:"):
            link.replace_self(link.children)


def setup(app):
    app.connect("doctree-read", place_is_no_link)
    app.connect("autodoc-process-docstring", as_it_stands, priority=1)
    app.connect("autodoc-process-docstring", as_it_stands, priority=999)
    app.connect("source-read", link_to_folder)

"""Formulas set by KaTeX while the site is built: pages need no script and no network.

An id like C-7 in a formula becomes the anchor #C-7 of the page. TeX that KaTeX does not
understand is a warning at its place.
"""

import html
import json
import pathlib
import re
import shutil
import subprocess

from docutils import nodes
from sphinx.util import logging

KATEX = pathlib.Path("/usr/share/javascript/katex")  # Debian: libjs-katex
logger = logging.getLogger(__name__)


class Typesetter:
    """One node process for all formulas."""

    def __init__(self):
        self.node = None
        self.known = {}

    def set(self, tex, display):
        if self.node is None:
            script = pathlib.Path(__file__).with_name("typeset.js")
            self.node = subprocess.Popen(["node", script, KATEX / "katex.js"], text=True,
                                         stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        if (tex, display) not in self.known:
            print(json.dumps({"tex": tex, "display": display}), file=self.node.stdin,
                  flush=True)
            self.known[tex, display] = json.loads(self.node.stdout.readline())
        return self.known[tex, display]

    def end(self, *_):
        if self.node is not None:
            self.node.communicate()
            self.node = None


def typeset(writer, node, display):
    answer = writer.builder.app.katex.set(node.astext(), display)
    if "error" in answer:
        logger.warning("%s", answer["error"], location=node)
    return answer.get("html", html.escape(node.astext()))


def visit_inline(writer, node):
    writer.body.append(f'<span class="math">{typeset(writer, node, False)}</span>')
    raise nodes.SkipNode


def visit_block(writer, node):
    ids = re.findall(r"\\tag\{([A-Z]+-\d+)\}", node.astext())
    anchors = "".join(f'<span id="{each}"></span>' for each in ids)
    writer.body.append(f'<div class="math">{anchors}{typeset(writer, node, True)}</div>')
    raise nodes.SkipNode


def copy_styles(app, error):
    """The style sheet and its fonts, one format of each."""
    if error is None and app.builder.format == "html":
        to = pathlib.Path(app.outdir, "_static/katex")
        shutil.copytree(KATEX / "fonts", to / "fonts", dirs_exist_ok=True)
        shutil.copy(KATEX / "katex.min.css", to)


def setup(app):
    app.katex = Typesetter()
    app.add_html_math_renderer("katex", (visit_inline, None), (visit_block, None))
    app.add_css_file("katex/katex.min.css")
    app.connect("build-finished", copy_styles)
    app.connect("build-finished", app.katex.end)
    return {"parallel_read_safe": True}

"""Sphinx's settings for the book. Its pages load nothing from other sites, so that they can be read offline."""

from __future__ import annotations

from typing import Any

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.application import Sphinx
from sphinx.writers.html5 import HTML5Translator

project = html_title = "ROS 2 services and actions on a humanoid"
author = "the course's authors"
html_show_copyright = False
language = "en"

extensions = ["myst_nb"]

html_theme = "furo"
html_static_path = ["static"]
html_css_files = ["book.css"]
html_copy_source = False
html_show_search_summary = False  # a summary fetches pages, which browsers forbid for local files
html_math_renderer = "mathml"

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
nb_execution_mode = "off"  # the chapters are executed beforehand
nb_merge_streams = True
nb_ipywidgets_js: dict[str, dict[str, str]] = {}
suppress_warnings = ["mystnb.unknown_mime_type", "misc.highlighting_failure"]


def setup(sphinx: Sphinx) -> None:
    """Register "mathml", formulas that browsers render without a script or a font, and the translator below."""
    sphinx.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    sphinx.set_translator("html", BookTranslator)


class BookTranslator(HTML5Translator):
    """Gives a level to the captions of the tables of contents, which are headings; Sphinx gives them none."""

    def starttag(
        self, node: nodes.Element, tagname: str, suffix: str = "\n", empty: bool = False, **attributes: Any
    ) -> str:
        """Return an opening tag."""
        if attributes.get("ROLE") == "heading":
            attributes["aria-level"] = "2"
        return super().starttag(node, tagname, suffix, empty, **attributes)


def _inline(translator: HTML5Translator, node: nodes.math) -> None:
    translator.body.append(tex2mathml(node.astext()))
    raise nodes.SkipNode


def _block(translator: HTML5Translator, node: nodes.math_block) -> None:
    translator.body.append(f'<div class="math">{tex2mathml(node.astext(), as_block=True)}</div>')
    raise nodes.SkipNode

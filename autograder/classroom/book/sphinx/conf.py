"""Sphinx's settings of the book. Nothing in its pages comes from another site, so it is read without a network."""

from __future__ import annotations

project = html_title = "ROS 2 services and actions on a humanoid"
author = "the course's authors"
html_show_copyright = False
language = "en"

extensions = ["myst_nb", "autograder.classroom.book.mathml"]
exclude_patterns: list[str] = []

html_theme = "furo"
html_static_path = ["static"]
html_css_files = ["book.css"]
html_copy_source = False
html_show_search_summary = False  # it would fetch pages, which browsers refuse for files on the disk
html_math_renderer = "mathml"

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
nb_execution_mode = "off"  # the chapters are executed beforehand
nb_merge_streams = True
nb_ipywidgets_js: dict[str, dict[str, str]] = {}
suppress_warnings = ["mystnb.unknown_mime_type", "misc.highlighting_failure"]

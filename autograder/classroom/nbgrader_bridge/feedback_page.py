"""nbgrader's feedback page, whose list shows the title of each check; stock nbgrader shows "Test cell" for each.

A key that formgrader shows to the marker is not on the page.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from nbconvert.exporters import HTMLExporter
from nbconvert.preprocessors import Preprocessor
from nbformat import NotebookNode
from traitlets import Bool
from traitlets.config import Config

TEMPLATES = Path(__file__).parent / "templates"
TEMPLATE = "checks_by_title"
KEY = "key-"  # the beginning of the ids of cells that only the marker may see
_POINTS = re.compile(r"\s*\(\d+ points?\)$")


class FeedbackPage(HTMLExporter):
    """Renders feedback with the course's template, which extends nbgrader's template."""

    def __init__(self, config: Config, **options: Any) -> None:
        nbgraders = config.HTMLExporter
        folders = list(nbgraders.extra_template_basedirs)
        ours = Config()
        ours.FeedbackPage.template_name = TEMPLATE
        ours.FeedbackPage.extra_template_basedirs = [str(TEMPLATES), *folders]
        # In these folders the course's template finds nbgrader's feedback/index.html.j2 and its style sheet.
        ours.FeedbackPage.extra_template_paths = [*nbgraders.extra_template_paths, *folders]
        super().__init__(config=Config(config, **ours), **options)

    def default_filters(self) -> Iterable[tuple[str, Callable[..., Any]]]:
        """Add the filter `check_title` for the template."""
        yield from super().default_filters()
        yield ("check_title", check_title)


class WithoutKeys(Preprocessor):
    """Removes the cells that only the marker may see."""

    enabled = Bool(True).tag(config=True)

    def preprocess(self, nb: NotebookNode, resources: Any) -> tuple[NotebookNode, Any]:
        """Remove them."""
        nb.cells = [cell for cell in nb.cells if not cell.get("id", "").startswith(KEY)]
        return nb, resources


def check_title(cell: NotebookNode) -> str:
    """Return the title of a check or a criterion: the first line of its generated cell, without the points."""
    first = next(iter(cell.source.splitlines()), "")
    return _POINTS.sub("", first.lstrip("# ")) or str(cell.metadata.nbgrader.grade_id)

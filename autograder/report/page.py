"""An HTML report with verdicts, diagrams and pictures, in one file without references."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from markupsafe import Markup

from autograder.engine.verdict import Grade
from autograder.report.rendering import drawn, write_html


@dataclass(frozen=True)
class Section:
    """One grade with the drawings (SVG) that explain its verdicts, by check id."""

    heading: str
    grade: Grade
    drawings: Mapping[str, Sequence[str]] = field(default_factory=dict)


def write_page(
    path: Path,
    *,
    title: str,
    introduction: str,
    figures: Sequence[str] = (),
    sections: Sequence[Section] = (),
) -> None:
    """Write an HTML page. `figures` and the drawings are trusted markup; all other texts are escaped."""
    write_html(
        path,
        "page.html",
        title=title,
        introduction=introduction,
        figures=[Markup(figure) for figure in figures],
        sections=[(section, drawn(section.grade, section.drawings)) for section in sections],
    )

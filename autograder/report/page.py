"""An HTML report with verdicts, diagrams and pictures, in one file without references."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, select_autoescape
from markupsafe import Markup

from autograder.engine.verdict import Grade
from autograder.report.table import summary


@dataclass(frozen=True)
class Section:
    """One grade with the diagrams (SVG) that explain its verdicts, by check id."""

    heading: str
    grade: Grade
    diagrams: Mapping[str, str] = field(default_factory=dict)


def write_page(
    path: Path,
    *,
    title: str,
    introduction: str,
    figures: Sequence[str] = (),
    sections: Sequence[Section] = (),
) -> None:
    """Write an HTML page. `figures` and the diagrams are trusted markup; all other texts are escaped."""
    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=select_autoescape(default=True),
    )
    html = environment.get_template("page.html").render(
        title=title,
        introduction=introduction,
        figures=[Markup(figure) for figure in figures],
        sections=[
            (section, {check: Markup(svg) for check, svg in section.diagrams.items()}) for section in sections
        ],
        summary=summary,
    )
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(html, encoding="utf-8")

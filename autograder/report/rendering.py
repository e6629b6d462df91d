"""Makes HTML pages from the templates beside this file: one file each, without scripts or references."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined, select_autoescape
from markupsafe import Markup

from autograder.engine.verdict import CheckVerdict, Grade
from autograder.report.table import MARKS, SHOWN, summary

ENVIRONMENT = Environment(
    loader=FileSystemLoader(Path(__file__).parent / "templates"),
    autoescape=select_autoescape(default=True),
    undefined=StrictUndefined,
    trim_blocks=True,
    lstrip_blocks=True,
)
ENVIRONMENT.globals |= {
    "summary": summary,
    "marks": {status: mark for status, (mark, _) in MARKS.items()},
    "shown": SHOWN,
}


@dataclass(frozen=True)
class Drawn:
    """The grader's drawings (trusted markup), or the earlier check that already shows the same ones."""

    svgs: Sequence[Markup]
    as_at: CheckVerdict | None = None


def write_html(path: Path, template: str, **values: Any) -> None:
    """Fill a template; every text except Markup is escaped."""
    html = ENVIRONMENT.get_template(template).render(**values)
    path.parent.mkdir(parents=True, exist_ok=True)
    # A student's program may print an unpaired surrogate.
    path.write_text(html, encoding="utf-8", errors="backslashreplace")


def drawn(grade: Grade, drawings: Mapping[str, Sequence[str]]) -> dict[str, Drawn]:
    """Return the drawings to show, by the check's id; drawings shared by several checks are shown only once."""
    first: dict[tuple[str, ...], CheckVerdict] = {}
    shown: dict[str, Drawn] = {}
    for check in grade.checks:
        if svgs := tuple(drawings.get(check.id, ())):
            owner = first.setdefault(svgs, check)
            shown[check.id] = Drawn(list(map(Markup, svgs))) if owner is check else Drawn([], owner)
    return shown


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

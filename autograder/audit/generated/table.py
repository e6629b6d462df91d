"""What is printed of generated faults: a line for each, a table by operator, the survivors, the figures."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Sequence

from rich.console import Console
from rich.table import Table
from rich.text import Text

from autograder.audit.generated.fault import Judged
from autograder.audit.generated.mutant import Mutant


def print_judged(console: Console, judged: Judged, *, earlier: bool = False) -> None:
    """Print one graded mutant; `earlier`: its grade is from a record."""
    grade = judged.run.grade
    mark, colour = ("✓", "green") if judged.lost_points else ("✗", "red")
    score = grade.score if judged.is_graded else "not graded"
    by = "" if judged.lost_by_visible or not judged.lost_points else "  (hidden checks only)"
    facts = f"{score}/{grade.max_score}  {judged.run.seconds:.0f} s{by}{'  (kept)' if earlier else ''}"
    console.print(Text.assemble((f"{mark} ", colour), f"{judged.mutant.name}  ", (facts, "dim")))
    if not judged.lost_points:
        console.print(Text(f"    {judged.mutant.sentence}", colour))


def table_of_faults(
    exercise: str, made: Sequence[Mutant], equivalent: Collection[str], judged: Sequence[Judged]
) -> Table:
    """Return the table by operator."""
    table = Table(
        title=f"Generated faults of {exercise}", title_justify="left", show_edge=False, padding=(0, 1, 0, 0)
    )
    table.add_column("operator", no_wrap=True)
    for heading in ("made", "equivalent", "graded", "lost points", "by visible"):
        table.add_column(heading, justify="right")
    for operator in dict.fromkeys(mutant.operator for mutant in made):
        ours = [mutant for mutant in made if mutant.operator == operator]
        graded = [one for one in judged if one.mutant.operator == operator]
        counts = Counter({name: sum(getattr(one, name) for one in graded) for name in _COUNTED})
        row = [
            len(ours),
            sum(mutant.name in equivalent for mutant in ours),
            *(counts[name] for name in _COUNTED),
        ]
        style = "bold red" if counts["lost_points"] < len(graded) else ""
        table.add_row(operator, *map(str, row), style=style)
    return table


def survivors(judged: Sequence[Judged]) -> list[str]:
    """Return the lines that say what was wrong with those that kept full marks, or were not graded."""
    lines = []
    for one in judged:
        if not one.lost_points:
            why = "kept full marks" if one.is_graded else f"was not graded: {one.run.grade.reason}"
            changes = (f"      {line}" for line in one.mutant.changed_lines())
            lines += [f"{one.mutant.name} {why}", f"    {one.mutant.sentence}", *changes, ""]
    return lines


def figures(judged: Sequence[Judged]) -> list[str]:
    """Return the figures, each as a line."""
    graded = [one for one in judged if one.is_graded]
    lost, visible = (sum(getattr(one, name) for one in graded) for name in _COUNTED[1:])
    lines = [
        f"{lost} of {len(graded)} lost points ({_percent(lost, graded)}), "
        f"{visible} by visible checks alone ({_percent(visible, graded)})"
    ]
    if unknown := len(judged) - len(graded):
        lines.append(f"not graded: {unknown}")
    return lines


_COUNTED = ("is_graded", "lost_points", "lost_by_visible")


def _percent(part: int, whole: Sequence[object]) -> str:
    return f"{100 * part / len(whole):.0f} %" if whole else "none"

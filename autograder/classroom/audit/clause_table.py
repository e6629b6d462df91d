"""The table of an exercise's clauses: what holds each of them, and in which situations that was judged.

It is made of the recorded transcripts of a correct submission, so it says what is judged, not what was meant to be.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping

from autograder.classroom.audit.known_submission import known_submissions
from autograder.classroom.audit.recorded import Case, cases
from autograder.engine.clauses import clauses_in
from autograder.engine.exercise import exercises_folder, load_exercise

# By an obligation's sentence or a check's title: how often it was judged, by situation.
Judged = dict[str, Counter[str]]


def clause_table(exercise: str) -> str:
    """Return the table in Markdown: a clause a row; one that nothing holds says so."""
    clauses = clauses_in(exercises_folder() / exercise / f"{exercise}.ipynb")
    judged = judged_by_clause(exercise)
    rows = [
        f"| {number}. {_cell(text)} | {_cell('; '.join(_held(judged[number]))) or '**nothing**'} |"
        for number, text in clauses.items()
    ]
    return "\n".join(
        [f"## {exercise}", "", "| Clause | What holds it (situations judged) |", "|---|---|", *rows, ""]
    )


def judged_by_clause(exercise: str) -> Mapping[int, Judged]:
    """Return what holds each clause, by its number, as the recorded transcripts of the correct submission show."""
    found: dict[int, Judged] = {
        number: {} for number in clauses_in(exercises_folder() / exercise / f"{exercise}.ipynb")
    }
    correct = {known.path.stem for known in known_submissions(exercise, only="correct/*")}
    recorded = {case.check.id: case for case in cases(exercise) if case.submission in correct}
    for check in load_exercise(exercise, hidden=True).checks:
        if case := recorded.get(check.id):
            for clauses, sentence, situations in _judged(case):
                for number in clauses:
                    found[number].setdefault(sentence, Counter()).update(situations)
    return found


def _judged(case: Case) -> Iterator[tuple[tuple[int, ...], str, Counter[str]]]:
    check = case.check
    if not check.obligations:
        scenarios = Counter(run.scenario.replace("_", " ") for run in case.transcripts)
        yield check.clauses, check.title, scenarios
    for obligation in check.obligations:
        for run in case.transcripts:
            yield obligation.clauses, obligation.sentence, obligation.judge(run)


def _held(judged: Judged) -> Iterator[str]:
    for sentence, situations in judged.items():
        yield f"{sentence} ({', '.join(f'{name} {times}' for name, times in sorted(situations.items()))})"


def _cell(text: str) -> str:
    return text.replace("|", "\\|").replace("\n", " ")

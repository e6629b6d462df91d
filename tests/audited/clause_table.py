"""The table of an exercise's clauses: which obligations and checks judge each one, and in which situations.

It is computed from the recorded transcripts of correct submissions, so it shows what is really judged.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping

from audited.recorded import Case, cases
from autograder.classroom.audit.known_submission import known_submissions
from autograder.engine.exercise import clauses_in, exercises_folder, load_exercise

# obligation's sentence or check's title -> situation -> number of times it was judged
Judged = dict[str, Counter[str]]


def clause_table(exercise: str) -> str:
    """Return the table in Markdown, one row per clause; a clause that nothing judges gets "nothing"."""
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
    """Return the obligations and checks that judge each clause, by clause number, from the recorded transcripts."""
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

"""What a program prints: it is stored, read as answers to a quiz, and quoted on pages."""

from __future__ import annotations

import io
import tempfile
from pathlib import Path

from bs4 import BeautifulSoup
from hypothesis import strategies as st
from rich.console import Console

from autograder.arena import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.classroom.pages.pages import write_class_page, write_student_page, write_submission_pages
from autograder.engine.arena_run import read_events
from autograder.engine.exercise import load_exercise
from autograder.engine.judging import judge
from autograder.engine.verdict import LENGTH_NOTE, LONGEST, CheckVerdict, Grade
from autograder.isolation.captured_output import CapturedOutput, OutputLine
from autograder.report.table import class_table, print_verdict
from fuzz import strategies as odd
from fuzz.fuzzer import Fuzzer

KEPT_KIB = 16
SCALE = 1.0


def require_kept_within_bounds(chunks: list[bytes]) -> None:
    """Require that output is kept up to its limit, that the rest is counted, and that the controller reads it."""
    lines: list[OutputLine] = []
    captured = CapturedOutput(KEPT_KIB, lines.append)
    for chunk in chunks:
        captured.feed(chunk)
    captured.close()
    kept = sum(len(line.text.encode(errors="surrogatepass")) for line in lines)
    assert kept <= 5 * KEPT_KIB * 1024  # an invalid UTF-8 byte becomes a three-byte replacement character
    assert len(lines) <= KEPT_KIB * 1024 // 32 + 2
    assert captured.dropped_bytes or sum(map(len, chunks)) <= kept + len(lines)
    assert [*captured.lines] == lines
    with odd.recorded() as (log, written):
        for line in lines:
            log.append(ev.NodeOutput(t=1.0, stream="stdout", text=line.text))
        assert len(read_events(written())) == len(lines)


def require_no_marks_for_words(texts: list[str]) -> None:
    """Require a verdict on a quiz whose program printed these lines, and not full marks."""
    said = [
        ev.NodeOutput(t=1.0 + index / 1000, stream="stdout", text=text) for index, text in enumerate(texts)
    ]
    events = [ev.NodeStarted(t=0.0), *said, ev.NodeExited(t=5.0, returncode=0), ev.ScenarioEnded(t=6.0)]
    verdicts = []
    for check in _QUIZ.checks:
        runs = [
            Transcript.from_events(scenario.name, scenario.draw(0), events, SCALE) for scenario in check.on
        ]
        verdicts.append(judge(check, runs))
    assert all(verdict.status in ("passed", "failed") for verdict in verdicts), verdicts
    assert not all(verdict.status == "passed" for verdict in verdicts)


def require_harmless_pages(words: tuple[str, str, str, str]) -> None:
    """Require that pages and tables show what was printed as text, whatever it is."""
    expected, observed, help, log = words
    verdict = CheckVerdict("one", "A title", "failed", 0, 1, expected, observed, help, 1.0, log)
    for name, most in LONGEST.items():
        assert len(getattr(verdict, name)) <= most + LENGTH_NOTE
    grade = Grade("battery_service", "anna", "namespaces", [verdict], seed=0)
    assert Grade.from_json(grade.to_json()) == grade
    console = Console(file=io.TextIOWrapper(io.BytesIO(), "utf-8", errors="backslashreplace"), width=100)
    print_verdict(console, verdict)
    console.print(class_table([grade]))
    with tempfile.TemporaryDirectory() as folder:
        write_submission_pages(Path(folder), grade, {})
        write_student_page(Path(folder), "anna", [grade])
        write_class_page(Path(folder), [grade])
        for page in Path(folder).rglob("*.html"):
            html = page.read_text(encoding="utf-8")
            assert odd.MARKUP not in html, page.name
            assert not BeautifulSoup(html, "html.parser").find_all("script"), page.name


_QUIZ = load_exercise("patterns", hidden=True)
_answers = st.tuples(
    st.one_of(st.integers(-1, 13).map(str), odd.texts),
    st.one_of(st.sampled_from(("topic", "service", "action", "TOPIC")), odd.texts),
    st.one_of(st.sampled_from("abcd"), odd.texts),
).map(" ".join)
_chunks = st.one_of(
    odd.blobs, st.tuples(odd.blobs, st.integers(1, 20)).map(lambda drawn: drawn[0] * drawn[1])
)
_quotes = st.tuples(odd.texts, odd.texts, odd.texts, odd.texts)

FUZZERS = (
    Fuzzer("output-kept", "output", st.lists(_chunks, max_size=8), require_kept_within_bounds, weight=0.5),
    Fuzzer(
        "output-quiz",
        "output",
        st.lists(st.one_of(_answers, odd.texts), max_size=15),
        require_no_marks_for_words,
    ),
    Fuzzer("output-quoted", "output", _quotes, require_harmless_pages, weight=0.3),
)

"""The verdicts of a self-check in a notebook: failed ones are open, lessons are links, all is there as text, too."""

from __future__ import annotations

from typing import Any

import pytest

from autograder.authoring.evidence import events as ev
from autograder.authoring.evidence.transcript import Transcript
from autograder.engine.exercise import load_exercise
from autograder.engine.verdict import CheckVerdict
from autograder.report import notebook_table as module
from autograder.report.notebook_table import NotebookTable, next_step

CHECKS = load_exercise("battery_service", hidden=False).checks


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, str]]:
    """What was displayed, newest last."""
    contents: list[dict[str, str]] = []

    class Display:
        def update(self, content: dict[str, str], **_: Any) -> None:
            contents.append(content)

    def display(content: dict[str, str], **_: Any) -> Display:
        contents.append(content)
        return Display()

    monkeypatch.setattr(module, "display", display)
    return contents


def test_failed_checks_are_open_and_the_others_folded(shown: list[dict[str, str]]) -> None:
    table = NotebookTable(CHECKS)
    assert f"{len(CHECKS)} not judged yet" in shown[-1]["text/html"]
    table.add(CheckVerdict(CHECKS[0].id, CHECKS[0].title, "passed", 1, 1))
    failed = CheckVerdict(
        CHECKS[1].id, "<b>", "failed", 0, 2, expected="a node", observed="none", help="Start it."
    )
    ready = ev.NodeReady(t=0.5, waited=0.5)
    table.draw(failed, [Transcript.from_events("in_order", {}, [ready])])
    table.add(failed)
    assert "<svg" not in shown[-1]["text/html"]  # nothing was sent
    signal = ev.NodeSignalled(t=1.0, signal="SIGINT")
    table.draw(failed, [Transcript.from_events("in_order", {}, [ready, signal])])
    html = shown[-1]["text/html"]
    assert "failed: &lt;b&gt; (0/2)" in html
    assert html.count("<details open") == 1
    assert "1 passed" in html
    assert f"{len(CHECKS) - 2} not judged yet" in html
    assert "<svg" in html
    assert "    expected  a node\n    observed  none\n    next  Start it." in shown[-1]["text/plain"]


def test_a_film_is_folded_below_its_check_and_has_an_alternative_text(shown: list[dict[str, str]]) -> None:
    table = NotebookTable(CHECKS)
    table.add(CheckVerdict(CHECKS[1].id, "A title", "failed", 0, 2, robot_time=2.0))
    table.film(CHECKS[1].id, "is being drawn …")
    assert "<dt>film</dt><dd>is being drawn …</dd>" in shown[-1]["text/html"]
    table.film(CHECKS[1].id, 'The "robot" falls', b"webp")
    folded = (
        '<details><summary>Film of these seconds</summary><div class="whole-width"><img src="data:image/webp'
    )
    assert (
        f'{folded};base64,d2VicA==" alt="The &#34;robot&#34; falls"></div></details>'
        in shown[-1]["text/html"]
    )
    table.film(CHECKS[1].id, "")
    assert "film" not in shown[-1]["text/html"].rpartition("</style>")[2]


def test_a_lesson_is_a_link_to_its_heading() -> None:
    title = "chapters/02_services.ipynb, “Break it: ask before there is an answer”"
    failed = CheckVerdict(
        "a", "A", "failed", 0, 1, help=f"<script> Read {title}.", lesson="02_services#m9-why"
    )
    href = "../../chapters/02_services.ipynb#Break-it:-ask-before-there-is-an-answer"
    assert next_step(failed) == f'&lt;script&gt; Read <a href="{href}">{title}</a>.'

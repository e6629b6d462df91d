"""The histories of processes on one time axis."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from drawings import read

from lab.errors import LabError
from lab.pictures.labels import Mark, rows_of, text_width
from lab.pictures.timeline import draw_timeline
from lab.running.processes import Process, ProcessHistory


@dataclass(frozen=True)
class Lived:
    """Stands for a node or program."""

    of: ProcessHistory

    def history(self) -> ProcessHistory:
        return self.of


def lived(name: str, began: float, ended: float, end: str, *lines: tuple[float, str]) -> Lived:
    return Lived(ProcessHistory(name, began, ended, end, [Mark(*line) for line in lines]))


def test_each_process_has_a_lane_with_its_lines_and_its_end() -> None:
    server = lived("where_am_i.py", 10.0, 12.0, "killed", (11.0, "asked"))
    client = lived(
        "ask.py", 10.5, 16.0, "exit status 0", (13.0, "[WARN] try 1: no answer"), (15.9, "at x 0.1 m")
    )
    drawing = read(draw_timeline(server, client, title="A retry"))
    for text in (
        *("A retry", "where_am_i.py", "ask.py", "asked", "killed", "[WARN] try 1: no answer", "at x 0.1 m"),
        "s since the first process began (system clock)",
    ):
        assert drawing.texts.count(text) == 1, text
    assert drawing.alt == (
        "A retry. where_am_i.py began at 0.00 s; 1.00 s: asked; 2.00 s: killed. "
        "ask.py began at 0.50 s; 3.00 s: [WARN] try 1: no answer; 5.90 s: at x 0.1 m; 6.00 s: exit status 0."
    )


def test_two_processes_of_one_file_have_numbers() -> None:
    drawing = read(draw_timeline(*(lived("server.py", at, at + 1.0, "stopped") for at in (0.0, 2.0))))
    assert {"server.py (1)", "server.py (2)"} <= set(drawing.texts)


def test_the_first_and_the_last_line_of_a_burst_are_shown() -> None:
    burst = [(1.0 + i / 1000, f"line {i}") for i in range(20)]
    drawing = read(draw_timeline(lived("crash.py", 0.0, 2.0, "exit status 1", *burst)))
    assert [text for text in drawing.texts if "line" in text] == ["line 0", "… 18 more lines …", "line 19"]


def test_a_long_line_is_cut_in_the_drawing_and_whole_in_its_words() -> None:
    drawing = read(draw_timeline(lived("long.py", 0.0, 2.0, "exit status 0", (1.0, "word " * 20 + "end"))))
    assert not any("end" in text for text in drawing.texts)
    assert "word end;" in drawing.alt


def test_without_a_process_there_is_nothing_to_draw() -> None:
    with pytest.raises(LabError, match="name the processes"):
        draw_timeline()


def test_no_label_covers_another_or_is_crossed_by_a_line() -> None:
    marks = [
        Mark(at, label)
        for at, label in ((0.0, "goal sent"), (0.01, "goal accepted"), (0.5, "x"), (3.0, "far"))
    ]
    rows = rows_of(marks, inches_per_second=1.0)
    assert rows == [0, 1, 2, 0]
    assert text_width("goal sent") > 0.5


def test_the_lines_of_a_process_have_the_times_at_which_they_came() -> None:
    program = "import sys; print('one', flush=True); sys.stderr.write('\\x1b two\\n')"
    process = Process(["-c", program], own_stderr=True)
    assert process.wait(20.0)
    history = ProcessHistory.of("program.py", process, was_stopped=False)
    assert sorted(line.label for line in history.lines) == ["one", "two"]
    assert history.ended is not None
    assert all(history.began < line.time <= history.ended for line in history.lines)
    assert history.end == "exit status 0"


def test_a_log_line_keeps_its_severity_and_its_words() -> None:
    process = Process(["-c", "print('[WARN] [1764.25] [robot.asker]: try 1:  no answer')"])
    assert process.wait(20.0)
    assert [line.label for line in ProcessHistory.of("p", process, was_stopped=False).lines] == [
        "[WARN] try 1: no answer"
    ]

"""The replay of a recording: the robot's motion, with captions of the events."""

from __future__ import annotations

import io
import os
import random
import shutil
import signal
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from itertools import count
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from urllib.request import urlopen

import mujoco
import numpy as np
import pytest
from mcap.writer import Writer
from PIL import Image, ImageSequence
from typer.testing import CliRunner

from autograder.authoring.evidence import events as ev
from autograder.recording.entry import METADATA
from autograder.recording.replay import web
from autograder.recording.replay.body import RecordedBody
from autograder.recording.replay.film import FRAME_RATE, HEIGHT, film
from autograder.recording.replay.recording import Kind, Moment, Recording, Span, UnusableRecording, span_of
from autograder.recording.replay.text import time_line
from course_cli.app import app
from falls import FALL, FELL_AT, recorded_fall, recordings, simulated, walk
from robot_sim.humanoid import Humanoid
from robot_sim.views.view import View

NEAR = 1e-4


@pytest.fixture(scope="module")
def fallen(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[float, np.ndarray]]:
    _, places = simulated("table")
    return recorded_fall(tmp_path_factory.mktemp("recordings"), "table"), places


def course(*arguments: object) -> Any:
    return CliRunner().invoke(app("replay"), ["replay", *map(str, arguments)], env={"COLUMNS": "200"})


def other_mcap(path: Path, metadata: dict[str, str] | None) -> Path:
    out = io.BytesIO()
    writer = Writer(out)
    writer.start(profile="ros2")
    if metadata is not None:
        writer.add_metadata(METADATA, metadata)
    writer.finish()
    path.write_bytes(out.getvalue())
    return path


def test_the_body_has_every_recorded_posture(fallen: Any) -> None:
    path, places = fallen
    recording = Recording.read(path)
    body = RecordedBody(recording)
    for posture, qpos in zip(recording.postures, places.values(), strict=True):
        body.show(posture.t)
        assert body.humanoid.data.qpos == pytest.approx(qpos, abs=NEAR)


def test_postures_are_interpolated(fallen: Any) -> None:
    path, _ = fallen
    recording = Recording.read(path)
    body = RecordedBody(recording)
    heights = []
    first, second = (posture.t for posture in recording.postures[-11:-9])
    for share in (0.0, 0.5, 1.0):
        body.show(first + share * (second - first))
        heights.append(body.humanoid.data.qpos[2])
    assert heights[0] > heights[1] > heights[2]
    assert heights[1] == pytest.approx((heights[0] + heights[2]) / 2)


def test_a_film_shows_the_recorded_robot_and_captions_of_the_events(fallen: Any, tmp_path: Path) -> None:
    path, places = fallen
    recording = Recording.read(path)
    count = film(recording, Span(FALL, FELL_AT + 0.3), tmp_path / "fall.webp", camera="side")
    with Image.open(tmp_path / "fall.webp") as moving:
        frames = [np.asarray(frame.convert("RGB")).astype(int) for frame in ImageSequence.Iterator(moving)]
    assert len(frames) == count == pytest.approx((FELL_AT + 0.3 - FALL) * FRAME_RATE + 1, abs=1)
    body = Humanoid("table")
    view = View(body, 480, 360, shadows=False)
    shown = {}

    def show(t: float) -> None:
        body.data.qpos[:] = places[min(places, key=lambda at: abs(at - t))]
        mujoco.mj_forward(body.model, body.data)

    view.fit("side", (show(FALL + number / FRAME_RATE) for number in range(count)))
    for name, t in (("upright", FALL), ("later", FALL + 8 / FRAME_RATE)):
        show(t)
        shown[name] = view.picture("side").astype(int)
    view.close()

    def unlike(frame: np.ndarray, picture: np.ndarray) -> float:
        return float((abs(frame[:HEIGHT] - picture) > 40).any(axis=2).mean())

    assert unlike(frames[0], shown["upright"]) < 0.01 < unlike(frames[0], shown["later"])
    assert unlike(frames[8], shown["later"]) < 0.01 < unlike(frames[8], shown["upright"])
    red = [((frame[HEIGHT:, :, 0] > 200) & (frame[HEIGHT:, :, 2] < 150)).sum() for frame in frames]
    before = int((FELL_AT - FALL) * FRAME_RATE)
    assert max(red[:before]) < 10
    assert min(red[before + 1 :]) > 40


def test_a_replay_shows_the_first_lost_point_by_default(fallen: Any) -> None:
    recording = Recording.read(fallen[0])
    assert span_of(recording, None, 0.6) == Span(pytest.approx(FELL_AT - 0.4), pytest.approx(FELL_AT + 0.2))
    assert span_of(recording, "accepts", 0.6).end == recording.end
    assert span_of(recording, "stays_up", None) == Span(0.0, recording.end)  # it lasted less than 6 s
    with pytest.raises(UnusableRecording, match=r"no check 'walks'.*stays_up, accepts"):
        span_of(recording, "walks", None)


def test_the_time_line_lists_the_events_in_order(fallen: Any) -> None:
    lines = [line.plain for line in time_line(Recording.read(fallen[0]))]
    times = [float(line.split()[0]) for line in lines]
    assert times == sorted(times)
    story = "\n".join(lines)
    wanted = [
        "goal “first” of walk_to",
        "accepted",
        "feedback of walk_to: distance_remaining=0.5",
        "walker: slow",
        "failed: The robot stays upright (0/2, stays_up)",
        "result of “first”: ABORTED",
        "passed: The goal is accepted (1/1, accepts)",
    ]
    places = [story.index(words) for words in wanted]
    assert places == sorted(places)


def test_much_feedback_is_summed_up() -> None:
    moments = [Moment(number / 10, Kind.FEEDBACK, f"feedback {number}") for number in range(11)]
    recording = Recording(Path("x"), {}, (), (), [*moments, Moment(2.0, Kind.EVENT, "end")])
    lines = [line.plain.strip() for line in time_line(recording)]
    assert [line.split("  ")[-1] for line in lines] == [
        "feedback 0",
        "… 9 more, at 10.0 Hz",
        "feedback 10",
        "end",
    ]


def test_output_of_a_program_cannot_control_the_terminal(tmp_path: Path) -> None:
    path = tmp_path / "walk.mcap"
    run = walk(ev.NodeOutput(t=0.7, stream="stdout", text="\x1b[2Jgone\x07 [red]mark[/red]"))
    path.write_bytes(recordings(run)["walk.mcap"])
    shown = course(path, "--text").output
    assert "gone" in shown
    assert "[red]mark[/red]" in shown
    assert "\x1b[2J" not in shown
    assert "\x07" not in shown


class Seen:
    """Stands for the web view, which a process can open only once; records what it shows."""

    url = "http://here/"

    def __init__(self, robot: Any, port: int) -> None:
        self.robot = robot
        self.heights: list[float] = []
        self.written: list[list[str]] = []
        self.is_closed = False
        seen.append(self)

    def show(self) -> None:
        self.heights.append(float(self.robot.data.qpos[2]))

    def write(self, lines: Sequence[tuple[str, str]]) -> None:
        self.written.append([text for text, _ in lines])

    def close(self) -> None:
        self.is_closed = True


seen: list[Seen] = []


def test_the_web_view_shows_the_fall_and_prints_each_event_once(
    fallen: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    recording = Recording.read(fallen[0])
    span = Span(FELL_AT - 0.3, FELL_AT + 0.1)
    expected = [moment for moment in recording.moments if span.start <= moment.t <= span.end]
    clock = count()  # each look at the clock is a frame of 0.04 s later
    shown: list[Moment] = []
    monkeypatch.setattr(web, "WebView", Seen)
    monkeypatch.setattr(
        web, "time", SimpleNamespace(monotonic=lambda: next(clock) / 25, sleep=lambda _: None)
    )
    frames = iter(range(120))  # long enough to begin again
    web.play(
        recording,
        span,
        0,
        on_ready=lambda url: None,
        on_moment=shown.append,
        keep_running=lambda: next(frames, None) is not None,
    )
    (view,) = seen
    assert shown == expected
    assert expected
    assert view.is_closed
    lowest = min(range(60), key=lambda frame: view.heights[frame])
    assert view.heights[0] > view.heights[5] > view.heights[lowest]
    assert max(view.heights[60:]) == pytest.approx(view.heights[0], abs=0.02)
    times = [float(time.removesuffix(" s")) for time, *_ in view.written]
    told_of_the_fall = [any("The robot stays upright" in line for line in lines) for lines in view.written]
    assert told_of_the_fall == [t >= FELL_AT for t in times]


def test_the_command_serves_a_page_and_ctrl_c_ends_it(fallen: Any) -> None:
    pytest.importorskip("mujoco.studio", reason="this MuJoCo is older than 4.0 and has no web viewer")
    command = [Path(sys.executable).with_name("course"), "replay", fallen[0]]
    with subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        env={**os.environ, "COLUMNS": "200"},
    ) as process:
        assert process.stdout
        said = []
        for line in process.stdout:
            said.append(line)
            if line.startswith("view: "):
                with urlopen(line.split()[1], timeout=10) as page:
                    assert page.status == 200
            if "failed: The robot stays upright" in line:
                process.send_signal(signal.SIGINT)
    assert process.returncode == 0, "".join(said)
    assert any("goal “first”" in line for line in said)


def test_the_command_writes_a_film_around_the_lost_point(fallen: Any, tmp_path: Path) -> None:
    ran = course(fallen[0], "--film", tmp_path / "film.gif", "--seconds", "0.4")
    assert ran.exit_code == 0, ran.output
    assert "walk_to · zoe · scenario walk, seed 4" in ran.output
    assert "from 1.2 to 1.6 s" in ran.output
    with Image.open(tmp_path / "film.gif") as moving:
        assert (moving.format, moving.n_frames) == ("GIF", 6)
        moving.seek(5)
        last = np.asarray(moving.convert("RGB")).astype(int)[HEIGHT:]
    assert ((last[:, :, 0] > 200) & (last[:, :, 2] < 150)).sum() > 40


def test_a_file_that_cannot_be_shown_is_refused_with_a_next_step(fallen: Any, tmp_path: Path) -> None:
    path = fallen[0]
    text = tmp_path / "notes.mcap"
    text.write_text("no recording at all")
    cut = tmp_path / "cut.mcap"
    cut.write_bytes(path.read_bytes()[:-3000])
    flipped = tmp_path / "flipped.mcap"
    shutil.copy(path, flipped)
    with flipped.open("r+b") as file:
        file.seek(2000)
        file.write(b"\xff" * 400)
    no_robot = tmp_path / "no_robot.mcap"
    no_robot.write_bytes(recordings(walk())["walk.mcap"])
    film_file = tmp_path / "film.webp"
    for arguments, words in [
        ((tmp_path / "missing.mcap",), "is not a file"),
        ((text,), "is not a recording of an arena, or it is damaged"),
        ((cut,), "is not a recording of an arena, or it is damaged"),
        ((flipped,), "is not a recording of an arena, or it is damaged"),
        ((other_mcap(tmp_path / "bag.mcap", None),), "not a recording of an arena; open it with Foxglove"),
        ((other_mcap(tmp_path / "new.mcap", {"format": "99"}),), "another version (format 99"),
        ((no_robot, "--film", film_file), "the scenario walk has no robot"),
        ((path, "--around", "walks"), "no check 'walks'"),
        ((path, "--film", tmp_path / "film.mp4"), "has the suffix .mp4; expected .webp or .gif"),
        ((path, "--film", film_file, "--camera", "roof"), "'roof' is not known"),
        ((path, "--seconds", "0"), "expected a positive number"),
    ]:
        ran = course(*arguments)
        assert ran.exit_code == 2, (arguments, ran.output)
        assert words in " ".join(ran.output.split()), ran.output
    assert not film_file.exists()


def test_a_damaged_file_is_read_or_refused_but_nothing_else(fallen: Any, tmp_path: Path) -> None:
    whole = fallen[0].read_bytes()
    path = tmp_path / "damaged.mcap"
    refused = 0
    for seed in range(60):
        draw = random.Random(seed)
        content = bytearray(whole)
        for _ in range(draw.choice((1, 3, 30))):
            content[draw.randrange(len(content))] = draw.randrange(256)
        path.write_bytes(content[: draw.randrange(len(content))] if draw.random() < 0.3 else content)
        try:
            Recording.read(path)
        except UnusableRecording as error:
            refused += "is not a recording of an arena, or it is damaged" in str(error)
    assert refused > 40


def test_another_robot_is_refused(fallen: Any) -> None:
    recording = Recording.read(fallen[0])
    other = replace(recording, joints=["third_arm", *recording.joints[1:]])
    with pytest.raises(UnusableRecording, match=r"another robot.*third_arm"):
        RecordedBody(other)

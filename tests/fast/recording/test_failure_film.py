"""Below a failed check of a self-check is a film of its seconds, if the robot moved then."""

from __future__ import annotations

import io
from dataclasses import replace
from typing import Any

import pytest
from PIL import Image

from autograder import self_check as module
from autograder.authoring.checks import check
from autograder.authoring.evidence.transcript import Transcript
from autograder.authoring.failure import Failure
from autograder.engine.verdict import CheckVerdict, Grade
from autograder.recording.replay import failure_film
from autograder.recording.replay.failure_film import MOST_FILMS, FailureFilms
from falls import FELL_AT, WALK, exercise, judged, simulated, stays_up, walk
from ros_runtime.cell_notice import CellNotice
from ros_runtime.workarounds.gl_backend import NoOpenGLError

NOTHING = ("", b"")


@check(on=WALK)
def walks_again(run: Transcript) -> None:
    """The robot walks again"""
    raise Failure(expected="a walk", observed="none", help="Walk.", at=FELL_AT + 0.1)


@pytest.fixture(scope="module")
def fall() -> Transcript:
    return walk(postures=simulated()[0])


def films() -> FailureFilms:
    return FailureFilms(exercise(stays_up, walks_again), Grade("walk_to", "me", "namespaces", seed=4))


def film_of(run: Transcript, **changes: Any) -> tuple[str, bytes]:
    return films().of(replace(judged(stays_up, run), **changes), [run])


def test_the_film_shows_the_fall_in_less_than_a_megabyte(fall: Transcript) -> None:
    words, webp = film_of(fall)
    assert len(webp) < 2**20
    with Image.open(io.BytesIO(webp)) as moving:
        assert moving.is_animated
    assert "from 0.0 to 2.0 s; the check fails at 1.5 s" in words
    assert "pelvis is 0.6" in words


def test_a_failure_without_a_time_or_a_moving_robot_has_none(fall: Transcript) -> None:
    stands = walk(postures=simulated(seconds=0.9)[0])
    assert film_of(fall, robot_time=None) == NOTHING
    assert film_of(stands) == NOTHING
    assert film_of(walk()) == NOTHING


def test_the_same_seconds_are_filmed_once(fall: Transcript) -> None:
    of_one = films()
    assert of_one.of(judged(stays_up, fall), [fall])[1]
    again = of_one.of(judged(walks_again, fall), [fall])
    assert again == ("These seconds are in the film of “The robot stays upright”.", b"")


def test_no_more_than_the_first_failures_are_filmed(
    fall: Transcript, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(failure_film, "film", lambda recording, span, file: file.write(b"film"))
    runs = [replace(fall) for _ in range(MOST_FILMS + 1)]
    of_one = films()
    made = [of_one.of(judged(stays_up, run), [run]) for run in runs]
    assert [webp == b"film" for _, webp in made] == [True] * MOST_FILMS + [False]


def test_without_opengl_the_reason_is_said(fall: Transcript, monkeypatch: pytest.MonkeyPatch) -> None:
    def film(*_: Any) -> None:
        raise NoOpenGLError("no EGL")

    monkeypatch.setattr(failure_film, "film", film)
    assert film_of(fall) == ("No film: no EGL", b"")


@pytest.mark.parametrize("error", [KeyboardInterrupt(), RuntimeError("broken")])
def test_a_film_that_is_interrupted_or_breaks_leaves_the_verdicts(
    error: BaseException, fall: Transcript, monkeypatch: pytest.MonkeyPatch
) -> None:
    shown: list[tuple] = []

    class Table:
        def __init__(self) -> None:
            self.evidence = {"stays_up": [fall]}

        def film(self, *entry: Any) -> None:
            shown.append(entry)

    def of(*_: Any) -> None:
        raise error

    monkeypatch.setattr(FailureFilms, "of", of)
    verdict: CheckVerdict = judged(stays_up, fall)
    grade = Grade("walk_to", "me", "namespaces", [verdict])
    module._add_films(Table(), CellNotice(), exercise(), grade)  # type: ignore[arg-type]
    assert shown == [("stays_up", "", b"")]

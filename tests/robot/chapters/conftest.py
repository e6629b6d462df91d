"""The chapters, each executed once."""

from __future__ import annotations

import fcntl
import os
import pickle
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from execution import CHAPTERS, Executed, execute
from gap_trials import GapTrials, trials_of

from autograder.classroom.book.chapter_run import missing_parts


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Give a test of gaps the trials of its chapter."""
    if "trial" in metafunc.fixturenames:
        metafunc.parametrize("trial", trials_of(metafunc.module.CHAPTER), ids=str)


@pytest.fixture(scope="session")
def executed(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Executed]:
    """`executed("02_services")` is that chapter after its run; each chapter runs once, also with several workers."""
    shared = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        shared = shared.parent

    def run_once(name: str) -> Executed:
        if why := missing_parts(CHAPTERS / f"{name}.ipynb"):
            pytest.skip(why)
        done = shared / f"{name}.executed"
        with (shared / f"{name}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not done.exists():
                done.write_bytes(pickle.dumps(_outcome(name, tmp_path_factory.mktemp(name))))
        outcome = pickle.loads(done.read_bytes())
        if isinstance(outcome, str):
            pytest.fail(outcome)
        return outcome

    return run_once


@pytest.fixture
def chapter(request: pytest.FixtureRequest, executed: Callable[[str], Executed]) -> Executed:
    """The chapter that the test's file names as CHAPTER, after its run."""
    return executed(request.module.CHAPTER)


@pytest.fixture(scope="module")
def gaps(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Iterator[GapTrials]:
    """The gaps of the chapter that the test's file names as CHAPTER, in one kernel."""
    trials = GapTrials(request.module.CHAPTER, tmp_path_factory.mktemp("gaps"))
    yield trials
    trials.end()


def _outcome(name: str, folder: Path) -> Executed | str:
    """The chapter after its run, or its error, so that a failed run is not repeated for each test."""
    try:
        executed = execute(name, folder)
        beside = {path.name for path in folder.iterdir()}
        assert beside == {"programs", ".progress.json"}, "what cells write is in the folder of programs"
        return executed
    except Exception:
        return traceback.format_exc()

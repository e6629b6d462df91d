"""Failed tests run once more, alone, except a correct submission that lost a point."""

from __future__ import annotations

from pathlib import Path

import pytest

from developer.test import LOST_POINTS, pass_alone, run_pytest

FAILS_AT_FIRST = """
from pathlib import Path

def test_steady():
    Path("steady.log").open("a").write("x")

def test_at_first():
    with Path("tries").open("a+") as tries:
        tries.write("x")
    assert len(Path("tries").read_text()) >= {needed}
"""
OF_A_CORRECT_ONE = """
def test_verdict(request):
    first = request.config.cache.get("seen", None) is None
    request.config.cache.set("seen", True)
    if {lost} and first:
        request.config.cache.set({key!r}, "walk_to/correct/plain")
    assert not first
"""


@pytest.fixture(autouse=True)
def without_plugins(monkeypatch: pytest.MonkeyPatch) -> None:
    """Loading them takes longer than these tests."""
    monkeypatch.setenv("PYTEST_DISABLE_PLUGIN_AUTOLOAD", "1")


@pytest.mark.parametrize(("needed", "passes"), [(2, True), (3, False)])
def test_failed_tests_run_again_without_the_others(
    tmp_path: Path, capfd: pytest.CaptureFixture[str], needed: int, passes: bool
) -> None:
    (tmp_path / "test_some.py").write_text(FAILS_AT_FIRST.format(needed=needed))
    assert not run_pytest([], tmp_path)
    assert pass_alone([], tmp_path) is passes
    assert (tmp_path / "tries").read_text() == "xx"
    assert (tmp_path / "steady.log").read_text() == "x"
    printed = capfd.readouterr().out
    assert "1 failed in parallel and run again, alone:\n  test_some.py::test_at_first" in printed
    assert (
        "passed alone, and should pass on a busy machine, too: test_some.py::test_at_first" in printed
    ) is passes


@pytest.mark.parametrize("lost", [True, False])
def test_a_point_that_a_correct_submission_lost_is_a_failure_at_once(tmp_path: Path, lost: bool) -> None:
    (tmp_path / "test_audit.py").write_text(OF_A_CORRECT_ONE.format(lost=lost, key=LOST_POINTS))
    assert not run_pytest([], tmp_path)
    assert pass_alone([], tmp_path) is not lost


def test_a_run_that_broke_before_any_test_is_a_failure(tmp_path: Path) -> None:
    assert not pass_alone([], tmp_path)

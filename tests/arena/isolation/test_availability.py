"""The machine's kinds of isolation are found by trying them, and reported."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from autograder.isolation import availability, bubblewrap
from autograder.isolation.arena_process import Kind
from autograder.isolation.availability import available_isolation


@pytest.fixture(autouse=True)
def _forget() -> Iterator[None]:
    availability.try_namespaces.cache_clear()
    yield
    availability.try_namespaces.cache_clear()


def test_isolation_can_be_switched_off_and_the_grade_is_labelled(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COURSE_ISOLATION", "none")
    isolation = available_isolation()
    assert (isolation.kind, isolation.trusted, isolation.label) == (Kind.NONE, False, "untrusted")
    assert "COURSE_ISOLATION=none" in isolation.reason


def test_root_can_select_another_user_which_does_not_allow_hidden_checks(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("COURSE_ISOLATION", "another-user")
    monkeypatch.setattr("os.geteuid", lambda: 0)
    isolation = available_isolation()
    assert (isolation.kind, isolation.trusted, isolation.label) == (Kind.ANOTHER_USER, False, "another-user")
    monkeypatch.setattr("os.geteuid", lambda: 1000)
    refused = available_isolation()
    assert (refused.kind, refused.label) == (Kind.NONE, "untrusted")
    assert "only root" in refused.reason


def test_an_unknown_isolation_is_refused_by_name(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COURSE_ISOLATION", "docker")
    with pytest.raises(ValueError, match="COURSE_ISOLATION is 'docker'; it can be"):
        available_isolation()


def test_without_bubblewrap_the_reason_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("COURSE_ISOLATION", raising=False)
    monkeypatch.setattr(bubblewrap, "_PROGRAM_FOLDERS", ("/nowhere",))
    isolation = available_isolation()
    assert isolation.label == "untrusted"
    assert "apt-get install bubblewrap" in isolation.reason


def test_a_bubblewrap_that_cannot_make_namespaces_is_quoted(
    monkeypatch: pytest.MonkeyPatch, tmp_path_factory: pytest.TempPathFactory
) -> None:
    monkeypatch.delenv("COURSE_ISOLATION", raising=False)
    monkeypatch.setattr(bubblewrap, "bwrap_path", lambda: "/bin/false")
    isolation = available_isolation()
    assert not isolation.trusted
    assert "ended with status 1 before the command ran" in isolation.reason


def test_where_it_works_the_grade_is_trusted(monkeypatch: pytest.MonkeyPatch, namespaces: Kind) -> None:
    monkeypatch.delenv("COURSE_ISOLATION", raising=False)
    isolation = available_isolation()
    assert (isolation.kind, isolation.trusted, isolation.label) == (namespaces, True, "namespaces")

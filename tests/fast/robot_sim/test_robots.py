"""The robots by name, and what is said where the packages of an optional one are not installed."""

from __future__ import annotations

import sys

import pytest

from robot_sim.__main__ import main
from robot_sim.body import MissingParts, body_named
from robot_sim.g1 import body
from ros_runtime.project import PROJECT

INSTALLER = PROJECT / "setup" / "install_g1.sh"


@pytest.mark.parametrize("package", body.PARTS)
def test_each_missing_part_is_named(package, monkeypatch):
    monkeypatch.setattr(body, "find_spec", lambda name: None)
    with pytest.raises(MissingParts, match=f"^the G1 needs {package}, which is not installed"):
        body.part_of(package)


def test_the_command_says_in_one_line_what_to_type(monkeypatch):
    monkeypatch.setattr(body, "find_spec", lambda name: None)
    body.g1_body.cache_clear()
    monkeypatch.setattr(sys, "argv", ["sim", "--robot", "g1"])
    with pytest.raises(SystemExit) as ended:
        main()
    message = str(ended.value.code)
    assert message.startswith("course sim: the G1 needs ")
    assert message.endswith(f"type:  bash {INSTALLER}")
    assert "\n" not in message
    assert INSTALLER.is_file()


def test_an_unknown_robot_is_named():
    with pytest.raises(ValueError, match="'g2' is not known; choose one of 'humanoid', 'g1'"):
        body_named("g2")

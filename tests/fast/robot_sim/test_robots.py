"""The robots by name, and what is said where the packages of an optional one are not installed."""

from __future__ import annotations

import sys

import pytest

from robot_sim.__main__ import main
from robot_sim.body import body_named
from robot_sim.g1 import body
from ros_runtime.project import PROJECT

INSTALLER = PROJECT / "setup" / "install_g1.sh"


@pytest.mark.parametrize("package", body.PARTS)
def test_the_command_names_a_missing_part_and_says_in_one_line_what_to_type(package, monkeypatch):
    monkeypatch.setattr(body, "PARTS", {package: ""})
    monkeypatch.setattr(body, "find_spec", lambda name: None)
    body.g1_body.cache_clear()
    monkeypatch.setattr(sys, "argv", ["sim", "--robot", "g1"])
    with pytest.raises(SystemExit) as ended:
        main()
    message = str(ended.value.code)
    assert message.startswith(f"course sim: the G1 needs {package}, which is not installed")
    assert message.endswith(f"type:  bash {INSTALLER}")
    assert "\n" not in message
    assert INSTALLER.is_file()


def test_an_unknown_robot_is_named():
    with pytest.raises(ValueError, match="'g2' is not known; choose one of 'humanoid', 'g1'"):
        body_named("g2")

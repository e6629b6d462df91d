"""Robots of MuJoCo Menagerie, as far as that goes without its download: a model of our own lies in its place."""

import time
import urllib.error
import urllib.request

import pytest

pytest.importorskip("mujoco_menagerie", reason="MuJoCo Menagerie needs Python 3.11")

from robot_sim.views.other_robots import OtherRobot, RobotUnavailable

POLE = """
<mujoco>
  <worldbody>
    <geom type="plane" size="1 1 0.1"/>
    <body name="base" pos="0 0 0.1">
      <freejoint/>
      <geom type="box" size="0.2 0.2 0.1" mass="5"/>
      <body pos="0 0 0.1">
        <joint name="hip" axis="0 1 0"/>
        <geom type="capsule" size="0.03" fromto="0 0 0 0 0 0.5" mass="1"/>
      </body>
    </body>
  </worldbody>
  <actuator><position joint="hip" kp="200" kv="20"/></actuator>
  <keyframe>{key}</keyframe>
</mujoco>"""


@pytest.fixture
def g1(tmp_path, monkeypatch):
    """Where Menagerie looks for a robot named unitree_g1; call it with the model's keyframe."""
    folder = tmp_path / "unitree_g1"
    folder.mkdir()
    monkeypatch.setenv("MENAGERIE_ROOT", str(tmp_path))
    return lambda key: (folder / "scene.xml").write_text(POLE.format(key=key))


def test_it_holds_the_posture_of_its_model(g1):
    g1('<key name="stand" qpos="0 0 0.1 1 0 0 0 0.3" ctrl="0.3"/>')
    robot = OtherRobot("unitree_g1")
    assert robot.posture == "stand"
    while robot.time < 2.0:
        robot.step()
    assert robot.data.joint("hip").qpos[0] == pytest.approx(0.3, abs=0.02)
    assert robot.data.body("base").xpos[2] == pytest.approx(0.1, abs=0.01)


def test_a_model_without_postures_is_shown_all_the_same(g1):
    g1("")
    assert OtherRobot("unitree_g1").posture == ""


def test_an_unknown_robot_is_refused_with_the_humanoids_there_are():
    with pytest.raises(RobotUnavailable, match=r"unitree_g2.*The humanoids are .*unitree_g1"):
        OtherRobot("unitree_g2")


def test_without_the_network_it_says_so_and_what_to_do(monkeypatch, tmp_path):
    def unreachable(*_arguments, **_options):
        raise urllib.error.URLError("no network")

    monkeypatch.setattr(urllib.request, "urlopen", unreachable)
    monkeypatch.setattr(time, "sleep", lambda seconds: None)  # Menagerie waits between its attempts
    monkeypatch.setenv("MENAGERIE_CACHE_DIR", str(tmp_path))
    monkeypatch.delenv("MENAGERIE_ROOT", raising=False)
    with pytest.raises(RobotUnavailable, match=r"no network.*MENAGERIE_ROOT"):
        OtherRobot("unitree_g1")

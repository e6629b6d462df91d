"""The body: masses, joints, scenes."""

from __future__ import annotations

import mujoco
import pytest

from robot_sim.model.build import build_model
from robot_sim.model.joint_names import ACTUATED_JOINTS
from robot_sim.parameters import Dimensions


@pytest.fixture(scope="module")
def model() -> mujoco.MjModel:
    return build_model()


def test_the_robot_weighs_38_kg(model):
    assert model.body_subtreemass[model.body("pelvis").id] == pytest.approx(38.0)


def test_it_has_34_actuators_named_after_their_joints(model):
    assert model.nv == 40
    assert [model.actuator(index).name for index in range(model.nu)] == ACTUATED_JOINTS
    assert all(model.joint(name).id >= 0 for name in ACTUATED_JOINTS)


def test_both_legs_reach_the_floor_alike(model):
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    size = Dimensions()
    for side, sign in (("l", 1), ("r", -1)):
        x, y, _ = data.site(f"{side}_sole").xpos - data.body("pelvis").xpos
        assert (x, y) == pytest.approx((size.sole_centre, sign * size.hip_half_width))


def test_the_table_scene_adds_a_cup_that_stays_on_the_table():
    model = build_model("table")
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 40)
    assert data.body("cup").xpos[2] == pytest.approx(0.755, abs=0.005)


def test_an_unknown_scene_is_refused_with_the_known_ones():
    with pytest.raises(ValueError, match=r"'moon' is not known.*'flat', 'table'"):
        build_model("moon")

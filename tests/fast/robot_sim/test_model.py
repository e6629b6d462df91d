"""The body: masses, joints, scenes."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from robot_sim.model.build import build_model
from robot_sim.model.joint_names import ACTUATED_JOINTS
from robot_sim.model.scenes import SCENES, scene_file


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
    left, right = (data.site(f"{side}_sole").xpos - data.body("pelvis").xpos for side in "lr")
    assert left == pytest.approx((0.03, 0.09, -0.67))
    assert right == pytest.approx((0.03, -0.09, -0.67))


@pytest.mark.parametrize("scene", SCENES)
def test_a_viewer_that_opens_a_scenes_file_shows_the_robot_of_the_simulator(model, scene):
    shown = mujoco.MjModel.from_xml_path(str(scene_file(scene)))
    assert [shown.actuator(index).name for index in range(shown.nu)] == ACTUATED_JOINTS
    bodies = {model.body(index).name: model.body(index).mass.item() for index in range(1, model.nbody)}
    joints = {model.joint(index).name: model.joint(index).range.tolist() for index in range(model.njnt)}
    assert {name: shown.body(name).mass.item() for name in bodies} == bodies
    assert {name: shown.joint(name).range.tolist() for name in joints} == joints
    np.testing.assert_array_equal(shown.actuator_gainprm, model.actuator_gainprm)
    np.testing.assert_array_equal(shown.actuator_forcerange, model.actuator_forcerange)
    assert shown.opt.timestep == model.opt.timestep


def test_both_sides_have_the_same_parts(model):
    """The file describes both sides separately, so a change must be made twice."""
    for left in (model.body(index) for index in range(model.nbody)):
        if left.name.startswith("l_"):
            right = model.body(f"r_{left.name[2:]}")
            assert abs(right.pos) == pytest.approx(abs(left.pos))
            assert right.mass == pytest.approx(left.mass)
            assert right.inertia == pytest.approx(left.inertia)


def test_the_table_scene_adds_a_cup_that_stays_on_the_table():
    model = build_model("table")
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 40)
    assert data.body("cup").xpos[2] == pytest.approx(0.755, abs=0.005)


def test_an_unknown_scene_is_refused_with_the_known_ones():
    with pytest.raises(ValueError, match=r"'moon' is not known.*'flat', 'table'"):
        build_model("moon")

"""The MuJoCo model of the G1: that of MuJoCo Playground on the course's floor, with capsules in place of its meshes."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robot_sim.model.side import SIDES

TIMESTEP = 0.002  # s
STANCE_HEIGHT = 0.76  # m, of the pelvis
DRY_FRICTION = 0.1  # N·m, in every joint
SENSORS = {  # the model's names of the sensors that the robot has, and the course's
    "gyro_pelvis": "imu_gyro",
    "accelerometer_pelvis": "imu_accelerometer",
    "orientation_pelvis": "imu_orientation",
}
FOOT_CONTACTS = 2  # the first pairs: each foot and the floor
FOOT_FRICTION = (0.6, 0.6, 0.02, 0.001, 0.001)  # sliding, turning and rolling
SOLE = (0.04, 0.0, -0.037)  # m, middle of the sole in the frame of the foot
RADII = {"hip": 0.055, "knee": 0.05, "waist": 0.06, "shoulder": 0.04, "elbow": 0.035, "wrist": 0.03}  # m
LIGHT, DARK, BLUE = (0.9, 0.91, 0.93, 1.0), (0.22, 0.23, 0.26, 1.0), (0.15, 0.45, 0.75, 1.0)
CAMERAS = {  # place (m) and axes of the picture, as in humanoid.xml from farther away
    "track": ((2.3, -2.3, 0.75), (0.7, 0.7, 0, -0.22, 0.22, 0.95)),
    "side": ((0, -3.5, 0.25), (1, 0, 0, 0, 0.06, 1)),
    "front": ((3.5, 0, 0.3), (0, 1, 0, -0.08, 0, 1)),
}


def g1_model(file: Path, shape: Callable[[mujoco.MjSpec], object] = lambda spec: None) -> mujoco.MjModel:
    """Compile the G1 of Playground's file, with the names that sensors and frames have in humanoid.xml.

    Args:
        file: g1_mjx_feetonly.xml. Its inertias are given, so that its meshes, which are elsewhere, can be left out.
        shape: called with the model before it is compiled, to change it.
    """
    world = Path(__file__).with_name("world.xml").read_text(encoding="utf-8")
    spec = mujoco.MjSpec.from_string(world, include={file.name: file.read_bytes()})
    for geom in [geom for geom in spec.geoms if geom.name not in ("floor", "left_foot", "right_foot")]:
        spec.delete(geom)
    for part in (*spec.meshes, *spec.cameras, *spec.lights, *spec.pairs[FOOT_CONTACTS:]):
        spec.delete(part)
    for sensor in spec.sensors:
        if sensor.name in SENSORS:
            sensor.name = SENSORS[sensor.name]
        else:
            spec.delete(sensor)
    for pair in spec.pairs:
        pair.condim, pair.friction = 4, FOOT_FRICTION
    spec.body("torso_link").name = "torso"
    _add_views(spec.body("pelvis"))
    _add_shape(spec)
    spec.option.timestep = TIMESTEP
    shape(spec)
    model = spec.compile()
    model.dof_damping[6:], model.dof_frictionloss[6:] = 0.0, DRY_FRICTION
    model.actuator_ctrllimited[:] = False
    model.body("pelvis").pos[2] = STANCE_HEIGHT
    return model


def _add_views(pelvis: Any) -> None:
    follow = mujoco.mjtCamLight.mjCAMLIGHT_TRACKCOM
    pelvis.add_light(
        mode=follow, pos=(0.8, -0.5, 3.5), dir=(-0.24, 0.15, -1), diffuse=(0.6,) * 3, cutoff=80, exponent=0
    )
    for name, (place, axes) in CAMERAS.items():
        camera = pelvis.add_camera(name=name, mode=follow, pos=place, fovy=40)
        camera.alt.type, camera.alt.xyaxes = mujoco.mjtOrientation.mjORIENTATION_XYAXES, axes


def _add_shape(spec: Any) -> None:
    """Draw a capsule from each joint to the next one, a chest, a head and hands; they meet only the floor."""
    box, ball, capsule = (
        getattr(mujoco.mjtGeom, f"mjGEOM_{kind}") for kind in ("BOX", "ELLIPSOID", "CAPSULE")
    )
    for body in spec.bodies:
        radius = next((RADII[part] for part in RADII if f"{part}_" in body.name), 0.0)
        for child in body.bodies:
            if radius and np.linalg.norm(child.pos) > 0.01:
                _add(body, capsule, (radius, 0, 0), LIGHT, fromto=[0, 0, 0, *child.pos])
    torso = spec.body("torso")
    _add(spec.body("pelvis"), box, (0.06, 0.08, 0.05), DARK, (0, 0, -0.05))
    _add(torso, box, (0.07, 0.1, 0.13), LIGHT, (0, 0, 0.17))
    _add(torso, box, (0.01, 0.07, 0.05), BLUE, (0.065, 0, 0.2))
    _add(torso, ball, (0.075, 0.065, 0.1), LIGHT, (0.02, 0, 0.42))
    _add(torso, ball, (0.05, 0.055, 0.05), DARK, (0.05, 0, 0.43))
    for side in SIDES:
        word = side.name.lower()
        _add(spec.body(f"{word}_wrist_yaw_link"), ball, (0.06, 0.03, 0.045), DARK, (0.07, 0, 0))
        foot = spec.body(f"{word}_ankle_roll_link")
        foot.name = f"{side.letter}_foot"
        foot.add_site(name=f"{side.letter}_sole", pos=SOLE)
        sole = spec.geom(f"{word}_foot")
        sole.group, sole.rgba = 0, DARK


def _add(body: Any, kind: Any, size: tuple, colour: tuple, place: tuple = (0, 0, 0), **ends: Any) -> None:
    colliding = {"contype": 0, "conaffinity": 1, "condim": 3}
    body.add_geom(type=kind, size=size, rgba=colour, pos=place, mass=0, group=0, **colliding, **ends)

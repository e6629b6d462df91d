"""The MuJoCo model of the humanoid in its scene."""

import mujoco

from robot_sim.model.actuators import actuators, sensors
from robot_sim.model.body_parts import humanoid_body
from robot_sim.model.floor import Floor
from robot_sim.model.scenes import HOLDS, scene_bodies
from robot_sim.parameters import Dimensions


def build_model(
    scene: str = "flat",
    *,
    timestep: float = 0.005,
    size: Dimensions | None = None,
    floor: Floor | None = None,
) -> mujoco.MjModel:
    """Compile the humanoid (38 kg, 34 actuators) standing in ``scene``.

    Args:
        scene: "flat", "table" or "stand".
        timestep: of the simulation, s.
        size: lengths of the body.
        floor: what it stands on; a level plane unless given.

    Raises:
        ValueError: the scene is not known.
    """
    return mujoco.MjModel.from_xml_string(model_xml(scene, timestep, size or Dimensions(), floor or Floor()))


def model_xml(scene: str, timestep: float, size: Dimensions, floor: Floor) -> str:
    """The model as MJCF text.

    Elliptic friction cones with a high impratio keep a grasped object from creeping out of the hand. All parts of
    the robot meet the world; the arms also meet trunk, thighs and each other, and so do the feet.
    """
    return f"""
<mujoco model="humanoid">
  <compiler angle="degree" autolimits="true"/>
  <option timestep="{timestep}" integrator="implicitfast" cone="elliptic" impratio="10"
          solver="Newton" iterations="20" ls_iterations="20" tolerance="1e-8"/>
  {LOOKS}
  {DEFAULTS}
  <worldbody>
    {floor.mjcf()}
    {humanoid_body(size)}
    {scene_bodies(scene)}
  </worldbody>
  <equality>{HOLDS.get(scene, "")}</equality>
  <actuator>{actuators()}</actuator>
  <sensor>{sensors()}</sensor>
</mujoco>"""


# No multisampling: without a graphics card it doubles the time of a picture.
LOOKS = """
<visual>
  <global offwidth="1920" offheight="1080"/>
  <headlight ambient="0.35 0.35 0.35" diffuse="0.5 0.5 0.5"/>
  <quality shadowsize="2048" offsamples="0"/>
</visual>
<asset>
  <texture name="sky" type="skybox" builtin="gradient" width="64" height="384"
           rgb1="0.6 0.75 0.9" rgb2="0.92 0.95 1"/>
  <texture name="floor" type="2d" builtin="checker" width="256" height="256"
           rgb1="0.75 0.78 0.8" rgb2="0.62 0.66 0.7"/>
  <material name="floor" texture="floor" texrepeat="2 2" texuniform="true"/>
</asset>"""

DEFAULTS = """
<default>
  <light diffuse="0.6 0.6 0.6"/>
  <geom contype="0" conaffinity="1" condim="3" friction="0.9 0.01 0.001" rgba="0.9 0.91 0.93 1"
        solref="0.01 1" solimp="0.9 0.95 0.001"/>
  <joint armature="0.02" damping="0.5"/>
  <default class="visual">
    <geom contype="0" conaffinity="0" mass="0" group="2"/>
    <default class="dark"><geom rgba="0.22 0.23 0.26 1"/></default>
    <default class="accent"><geom rgba="0.15 0.45 0.75 1"/></default>
    <default class="eye"><geom rgba="0.4 0.9 1 1"/></default>
  </default>
  <default class="foot"><geom mass="0" friction="1 0.02 0.001" rgba="0.2 0.2 0.22 1"/></default>
  <default class="pad">
    <geom contype="1" conaffinity="1" condim="4" friction="1.5 0.02 0.001" rgba="0.15 0.15 0.15 1"/>
  </default>
  <default class="furniture"><geom contype="1" conaffinity="1" rgba="0.6 0.45 0.3 1"/></default>
  <default class="waist"><joint armature="0.03" damping="1"/></default>
  <default class="hip"><joint armature="0.03" damping="0.5"/></default>
  <default class="ankle"><joint armature="0.01" damping="0.3"/></default>
  <default class="arm"><joint armature="0.02" damping="0.5"/></default>
  <default class="wrist"><joint armature="0.01" damping="0.2"/></default>
  <default class="finger"><joint armature="0.05" damping="2"/></default>
  <default class="head"><joint armature="0.01" damping="0.2"/></default>
</default>"""

"""MJCF of the humanoid's parts: pelvis, torso, head, legs and arms, from primitives.

Lengths in m, masses in kg, angles in degrees as MJCF's compiler is told. x is forward, y left, z up.
"""

from robot_sim.parameters import Dimensions

# Who meets whom, as contype and conaffinity. Bits: 1 the world, 2 the left foot, 4 the left arm, 8 the right arm.
FOOT_CONTACT = {"l": (2, 1), "r": (0, 3)}  # the feet meet the world and each other
ARM_CONTACT = {"l": (4, 9), "r": (8, 5)}  # an arm meets the world, the other arm and the body
MEETS_ARMS = 'conaffinity="13"'  # the body meets the world and both arms


def humanoid_body(size: Dimensions) -> str:
    """The whole robot as one MJCF body with a free joint; base_link is its pelvis, between the hips."""
    return f"""
<body name="pelvis" pos="0 0 {size.stance_height}">
  <freejoint name="root"/>
  <light mode="trackcom" pos="0.8 -0.5 3.5" dir="-0.24 0.15 -1" cutoff="80" exponent="0"/>
  <camera name="track" mode="trackcom" pos="1.9 -1.9 0.75" xyaxes="0.7 0.7 0 -0.22 0.22 0.95" fovy="40"/>
  <camera name="side" mode="trackcom" pos="0 -2.9 0.25" xyaxes="1 0 0 0 0.06 1" fovy="40"/>
  <camera name="front" mode="trackcom" pos="2.9 0 0.3" xyaxes="0 1 0 -0.08 0 1" fovy="40"/>
  <geom name="pelvis" type="box" {MEETS_ARMS} size="0.07 0.10 0.05" pos="0 0 0.03" mass="5"/>
  <site name="imu" pos="0 0 0.05" size="0.01"/>
  {torso()}
  {leg("l", size)}
  {leg("r", size)}
</body>"""


def torso() -> str:
    """Waist, chest with both arms, neck and head."""
    return f"""
<body name="waist" pos="0 0 0.09">
  <joint name="waist_yaw" class="waist" axis="0 0 1" range="-100 100"/>
  <inertial pos="0 0 0" mass="0.8" diaginertia="0.002 0.002 0.002"/>
  <geom class="dark" type="cylinder" size="0.05 0.03"/>
  <body name="torso">
    <joint name="waist_pitch" class="waist" axis="0 1 0" range="-30 60"/>
    <geom name="torso" type="box" {MEETS_ARMS} size="0.075 0.12 0.14" pos="0 0 0.19" mass="10"/>
    <geom class="accent" type="box" size="0.01 0.08 0.06" pos="0.07 0 0.22"/>
    {head()}
  </body>
  {arm("l")}
  {arm("r")}
</body>"""


def head() -> str:
    """Neck (pan) and head (tilt) with two eyes and a camera."""
    return f"""
<body name="neck" pos="0 0 0.36">
  <joint name="head_pan" class="head" axis="0 0 1" range="-90 90"/>
  <inertial pos="0 0 0" mass="0.3" diaginertia="0.0005 0.0005 0.0005"/>
  <geom class="dark" type="cylinder" size="0.03 0.03"/>
  <body name="head" pos="0 0 0.03">
    <joint name="head_tilt" class="head" axis="0 1 0" range="-40 50"/>
    <geom name="head" type="ellipsoid" {MEETS_ARMS} size="0.085 0.075 0.095" pos="0 0 0.09" mass="1.5"/>
    <geom class="dark" type="ellipsoid" size="0.05 0.058 0.03" pos="0.042 0 0.105"/>
    <geom class="eye" type="sphere" size="0.012" pos="0.086 0.026 0.108"/>
    <geom class="eye" type="sphere" size="0.012" pos="0.086 -0.026 0.108"/>
    <camera name="head_camera" pos="0.10 0 0.1" xyaxes="0 -1 0 0.3 0 0.95" fovy="75"/>
  </body>
</body>"""


def leg(side: str, size: Dimensions) -> str:
    """One leg: hip yaw, roll and pitch in one point, knee, ankle pitch and roll, a box for a sole."""
    y = size.hip_half_width if side == "l" else -size.hip_half_width
    contype, conaffinity = FOOT_CONTACT[side]
    return f"""
<body name="{side}_hip_yaw_link" pos="0 {y} 0">
  <inertial pos="0 0 0" mass="0.6" diaginertia="0.001 0.001 0.001"/>
  <joint name="{side}_hip_yaw" class="hip" axis="0 0 1" range="-60 60"/>
  <geom class="dark" type="sphere" size="0.05"/>
  <body name="{side}_hip_roll_link">
    <inertial pos="0 0 0" mass="0.6" diaginertia="0.001 0.001 0.001"/>
    <joint name="{side}_hip_roll" class="hip" axis="1 0 0" range="-45 45"/>
    <body name="{side}_thigh">
      <joint name="{side}_hip_pitch" class="hip" axis="0 1 0" range="-120 60"/>
      <geom name="{side}_thigh" type="capsule" {MEETS_ARMS}
            size="0.05" fromto="0 0 -0.04 0 0 {0.03 - size.thigh}" mass="3"/>
      <body name="{side}_shank" pos="0 0 {-size.thigh}">
        <joint name="{side}_knee" class="hip" axis="0 1 0" range="0 140"/>
        <geom type="capsule" size="0.04" fromto="0 0 -0.02 0 0 {0.05 - size.shank}" mass="1.8"/>
        <geom class="dark" type="sphere" size="0.052"/>
        <body name="{side}_ankle_link" pos="0 0 {-size.shank}">
          <inertial pos="0 0 0" mass="0.2" diaginertia="0.0003 0.0003 0.0003"/>
          <joint name="{side}_ankle_pitch" class="ankle" axis="0 1 0" range="-60 50"/>
          <body name="{side}_foot">
            <inertial pos="0.02 0 -0.03" mass="0.8" diaginertia="0.001 0.003 0.003"/>
            <joint name="{side}_ankle_roll" class="ankle" axis="1 0 0" range="-35 35"/>
            <geom name="{side}_sole" class="foot" type="box" contype="{contype}" conaffinity="{conaffinity}"
                  size="{size.sole_half_length} {size.sole_half_width} 0.0125"
                  pos="{size.sole_centre} 0 {0.0125 - size.ankle_height}"/>
            <geom class="dark" type="box" size="0.035 0.035 0.02" pos="0 0 -0.01"/>
            <site name="{side}_sole" pos="{size.sole_centre} 0 {-size.ankle_height}" size="0.005"/>
            <site name="{side}_foot_touch" type="box" rgba="0 0 0 0"
                  size="{size.sole_half_length + 0.005} {size.sole_half_width + 0.005} 0.02"
                  pos="{size.sole_centre} 0 {0.0125 - size.ankle_height}"/>
          </body>
        </body>
      </body>
    </body>
  </body>
</body>"""


def arm(side: str) -> str:
    """One arm of seven joints with a two-fingered hand that opens sideways."""
    y, roll_range = (0.17, "-20 120") if side == "l" else (-0.17, "-120 20")
    meets = 'contype="{}" conaffinity="{}"'.format(*ARM_CONTACT[side])
    return f"""
<body name="{side}_shoulder_pitch_link" pos="0 {y} 0.29">
  <joint name="{side}_shoulder_pitch" class="arm" axis="0 1 0" range="-170 70"/>
  <geom type="sphere" size="0.05" mass="0.6"/>
  <body name="{side}_shoulder_roll_link">
    <inertial pos="0 0 0" mass="0.3" diaginertia="0.0004 0.0004 0.0004"/>
    <joint name="{side}_shoulder_roll" class="arm" axis="1 0 0" range="{roll_range}"/>
    <body name="{side}_upper_arm">
      <joint name="{side}_shoulder_yaw" class="arm" axis="0 0 1" range="-90 90"/>
      <geom name="{side}_upper_arm" type="capsule" {meets} size="0.035" fromto="0 0 -0.05 0 0 -0.20" mass="1"/>
      <body name="{side}_forearm" pos="0 0 -0.22">
        <joint name="{side}_elbow" class="arm" axis="0 1 0" range="-135 0"/>
        <geom class="dark" type="sphere" size="0.037"/>
        <geom name="{side}_forearm" type="capsule" {meets} size="0.03" fromto="0 0 0 0 0 -0.15" mass="0.7"/>
        <body name="{side}_wrist_yaw_link" pos="0 0 -0.19">
          <joint name="{side}_wrist_yaw" class="wrist" axis="0 0 1" range="-120 120"/>
          <geom type="sphere" size="0.027" mass="0.15"/>
          <body name="{side}_wrist_pitch_link">
            <inertial pos="0 0 0" mass="0.1" diaginertia="0.0001 0.0001 0.0001"/>
            <joint name="{side}_wrist_pitch" class="wrist" axis="0 1 0" range="-90 90"/>
            <body name="{side}_hand">
              <joint name="{side}_wrist_roll" class="wrist" axis="1 0 0" range="-60 60"/>
              <geom name="{side}_palm" type="box" {meets} size="0.02 0.055 0.03" pos="0 0 -0.045" mass="0.25"/>
              <site name="{side}_grip" pos="0 0 -0.11" size="0.006" rgba="0 0 0 0"/>
              {finger(side, "finger_1", 1)}
              {finger(side, "finger_2", -1)}
            </body>
          </body>
        </body>
      </body>
    </body>
  </body>
</body>"""


def finger(side: str, name: str, direction: int) -> str:
    """One sliding finger; at 0 its pad meets the other's, at 0.045 m the hand is open."""
    return f"""
<body name="{side}_{name}" pos="0 {0.006 * direction} -0.075">
  <joint name="{side}_{name}" class="finger" type="slide" axis="0 {direction} 0" range="0 0.045"/>
  <geom name="{side}_{name}_pad" class="pad" type="box" size="0.014 0.006 0.035" pos="0 0 -0.03" mass="0.05"/>
  <site name="{side}_{name}_touch" type="box" size="0.016 0.008 0.037" pos="0 0 -0.03" rgba="0 0 0 0"/>
</body>"""

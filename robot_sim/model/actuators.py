"""MJCF of the humanoid's motors and sensors.

Legs are driven by torque, because the walking controller computes torques; everything above the hips is held
by position servos, as in most real humanoids' upper bodies.
"""

from robot_sim.model.joint_names import ARM, FINGERS, HEAD, LEG, SIDES, WAIST

LEG_TORQUE_LIMIT = dict(zip(LEG, (60, 120, 150, 150, 70, 50), strict=True))  # N·m

# position gain N·m/rad, damping N·m·s/rad, limit N·m
SERVOS = {
    "waist_yaw": (400, 20, 80),
    "waist_pitch": (600, 30, 120),
    "head_pan": (20, 1, 10),
    "head_tilt": (20, 1, 10),
    "arm": (200, 10, 40),
    "wrist": (60, 3, 12),
}
FINGER_SERVO = (800, 40, 25)  # N/m, N·s/m, N


def actuators() -> str:
    """All 34 actuators, each with the name of its joint, in the order of ``joint_names.ACTUATED_JOINTS``."""
    lines = [leg_motor(f"{side}_{joint}", LEG_TORQUE_LIMIT[joint]) for side in SIDES for joint in LEG]
    lines += [servo(joint, *SERVOS[joint]) for joint in WAIST + HEAD]
    for side in SIDES:
        lines += [servo(f"{side}_{j}", *SERVOS["wrist" if j.startswith("wrist") else "arm"]) for j in ARM]
        lines += [servo(f"{side}_{joint}", *FINGER_SERVO, reach="-0.02 0.045") for joint in FINGERS]
    return "\n".join(lines)


def leg_motor(joint: str, limit: int) -> str:
    """A torque motor with ±``limit`` N·m."""
    return f'<motor name="{joint}" joint="{joint}" ctrlrange="-{limit} {limit}"/>'


def servo(joint: str, gain: int, damping: int, limit: int, reach: str = "-3.2 3.2") -> str:
    """A position servo: torque = gain·(command - position) - damping·velocity, within ±limit."""
    return (
        f'<position name="{joint}" joint="{joint}" kp="{gain}" kv="{damping}" '
        f'forcerange="-{limit} {limit}" ctrlrange="{reach}"/>'
    )


def sensors() -> str:
    """Inertial sensor, the centre of mass and its velocity, and the contact forces of soles and fingers."""
    touches = [f"{side}_foot_touch" for side in SIDES]
    touches += [f"{side}_{finger}_touch" for side in SIDES for finger in FINGERS]
    return "\n".join(
        [
            '<gyro name="imu_gyro" site="imu"/>',
            '<accelerometer name="imu_accelerometer" site="imu"/>',
            '<framequat name="imu_orientation" objtype="site" objname="imu"/>',
            '<subtreecom name="com" body="pelvis"/>',
            '<subtreelinvel name="com_velocity" body="pelvis"/>',
            *(f'<touch name="{name}" site="{name}"/>' for name in touches),
        ]
    )

"""Every constant of the humanoid and of its walking, with its unit."""

from dataclasses import dataclass, field

from robot_sim.model.dimensions import Dimensions

GRAVITY = 9.81  # m/s²


@dataclass(frozen=True, slots=True)
class WalkingLimits:
    """What ``walk_velocity`` accepts; a faster command is walked at the limit."""

    forward: float = 0.40  # m/s
    backward: float = 0.20  # m/s
    sideways: float = 0.12  # m/s
    turn: float = 0.45  # rad/s
    linear_deadband: float = 0.004  # m/s; slower than this is standing
    turn_deadband: float = 0.008  # rad/s


@dataclass(frozen=True, slots=True)
class HeightLimits:
    """How low the robot can crouch, and how fast it goes down and up."""

    lowest: float = 0.45  # m, pelvis above the floor; lower, the ankles reach their stops
    speed: float = 0.15  # m/s
    risen: float = 0.015  # m below the stance from which it may walk


@dataclass(frozen=True, slots=True)
class HeightChangeParameters:
    """When a phase of crouching or standing up has ended."""

    balanced: float = 0.02  # m, DCM from the middle of the feet, to set out
    least_load_share: float = 0.4  # of what both feet bear, on either, to set out
    thrown: float = 0.05  # m, DCM from the middle of the feet; the weight has to be shifted again
    near: float = 0.01  # m, from the height wanted, to settle
    settled: float = 0.005  # m, from the height wanted
    upright: float = 0.998  # z component of the pelvis' up-vector
    still: float = 0.02  # m/s
    hold: float = 0.2  # s, that a condition has to last
    patience: float = 12.0  # s, for all phases; the longest way takes 2 s


@dataclass(frozen=True, slots=True)
class StepLimits:
    """How far the body may move in one step, in the frame of the stance foot."""

    forward: float = 0.18  # m
    backward: float = 0.10  # m
    outward: float = 0.10  # m, towards the side of the swing foot
    inward: float = 0.02  # m
    turn_outward: float = 0.30  # rad
    turn_inward: float = 0.12  # rad
    reach_forward: float = 0.40  # m, landing of the swing foot from the stance foot
    reach_backward: float = 0.36  # m
    reach_inner: float = 0.115  # m, closer would touch the stance foot
    reach_outer: float = 0.50  # m


@dataclass(frozen=True, slots=True)
class GaitParameters:
    """Rhythm of the steps and the thresholds between standing, shifting and stepping."""

    duration: float = 0.44  # s, nominal length of a step
    double_support: float = 0.05  # s, at its start
    min_duration: float = 0.22  # s
    max_duration: float = 0.60  # s
    timing_rate: float = 9.0  # s/s, how fast the touchdown time may move
    feet_width: float = 0.18  # m, between the sole centres
    lift: float = 0.04  # m, height of the swing foot
    planned_steps: int = 3

    shift_gain: float = 1.5
    shift_tolerance: float = 0.02  # m, DCM error at which a foot may be lifted
    shift_min_time: float = 0.10  # s
    shift_max_time: float = 1.00  # s

    capture_duration: float = 0.28  # s, a step that catches a push
    capture_double_support: float = 0.02  # s
    capture_forward: float = 0.085  # m, DCM offset in standing that makes it step
    capture_sideways: float = 0.13  # m

    lifted_height: float = 0.015  # m, a sole this high without load is put down by a step

    touchdown_force: float = 15.0  # N
    touchdown_progress: float = 0.6  # of the swing; earlier contact is scuffing
    freeze_landing: float = 0.9  # of the swing; later the landing is not moved

    stand_dcm_forward: float = 0.07  # m, DCM offset at touchdown from which standing is safe
    stand_dcm_sideways: float = 0.10  # m
    stand_feet_offset: float = 0.05  # m, fore-aft distance of the feet
    stand_feet_width: float = 0.06  # m, deviation from feet_width

    goal_tolerance: float = 0.02  # m
    goal_yaw_tolerance: float = 0.05  # rad
    goal_facing_distance: float = 0.7  # m, farther goals are faced while walking


@dataclass(frozen=True, slots=True)
class SlopeParameters:
    """How the slope of the floor is felt, and what is believed of it."""

    filter_time: float = 0.2  # s
    level: float = 0.0175  # m/m; less is level
    steepest: float = 0.09  # m/m; more is a foot on its edge


@dataclass(frozen=True, slots=True)
class TippingParameters:
    """How the centre of pressure answers a foot that tips."""

    tolerated: float = 0.05  # rad, lean of the sole against the floor
    stiffness: float = 1.0  # m/rad
    damping: float = 0.03  # m·s/rad


@dataclass(frozen=True, slots=True)
class BalanceParameters:
    """Gains of the whole-body controller and limits of the contact forces."""

    stand_gain: float = 2.0  # CoP over DCM in standing
    sole_length_share: float = 0.80  # of the half-size the planned CoP may use
    sole_width_share: float = 0.75
    sole_edge_share: float = 0.90  # of the half-size the commanded CoP may use
    tilt_stiffness: float = 120.0  # 1/s², roll and pitch unless other gains are given
    tilt_damping: float = 18.0  # 1/s
    yaw_stiffness: float = 80.0  # 1/s²
    yaw_damping: float = 14.0  # 1/s
    height_stiffness: float = 120.0  # 1/s²
    height_damping: float = 20.0  # 1/s
    yaw_rate: float = 2.0  # rad/s, slew of the heading reference
    swing_stiffness: float = 900.0  # 1/s²
    swing_damping: float = 60.0  # 1/s
    swing_turn_stiffness: float = 400.0  # 1/s²
    swing_turn_damping: float = 36.0  # 1/s
    stance_damping: float = 10.0  # 1/s
    momentum_iterations: int = 2
    min_load: float = 0.2  # of the weight
    max_load: float = 2.5
    friction: float = 0.7
    yaw_moment_per_load: float = 0.05  # m, yaw moment a foot may carry per N of its load
    cop_shift_filter: float = 0.7  # kept of the filtered CoP shift after cop_shift_period
    cop_shift_period: float = 0.004  # s


@dataclass(frozen=True, slots=True)
class BatteryParameters:
    """A pack of eight lithium cells and what the robot asks of it."""

    capacity: float = 120.0  # W·h
    full_voltage: float = 33.6  # V, open circuit
    empty_voltage: float = 25.6  # V, open circuit
    resistance: float = 0.05  # Ω
    idle_power: float = 18.0  # W, computers and sensors
    motor_loss: float = 0.025  # W/(N·m)², heat in a windings' resistance


@dataclass(frozen=True, slots=True)
class ImuParameters:
    """Imperfection of the inertial sensor (standard deviations)."""

    gyro_bias: float = 0.002  # rad/s, drawn once for each seed
    gyro_noise: float = 0.001  # rad/s
    accelerometer_bias: float = 0.05  # m/s², likewise
    accelerometer_noise: float = 0.02  # m/s²


@dataclass(frozen=True, slots=True)
class EstimateParameters:
    """How sensors are blended into the state the robot believes to be in."""

    contact_force: float = 30.0  # N; a foot that bears more stands still
    tilt_gain: float = 0.3  # 1/s, of the accelerometer's correction
    odometry_gain: float = 0.2  # of the velocity's error, each timestep
    anchor_gain: float = 0.1  # of the position's error, each timestep
    still: float = 0.03  # rad/s; a slower gyro shows its bias
    bias_time: float = 0.5  # s, to learn it


@dataclass(frozen=True, slots=True)
class FallThresholds:
    """Beyond either the robot has fallen."""

    base_height: float = 0.38  # m
    up: float = 0.6  # z component of the up-vector


@dataclass(frozen=True, slots=True)
class ReachParameters:
    """How a hand is brought to a place."""

    gain: float = 6.0  # 1/s, of the measured error
    damping: float = 0.05  # m, of the least squares
    rotation_weight: float = 0.3  # m/rad
    relaxation: float = 0.8  # 1/s, towards the relaxed posture
    joint_speed: float = 2.5  # rad/s
    turn_speed: float = 2.0  # rad/s, of the hand
    windup: float = 0.25  # rad, reference ahead of the measured joint


@dataclass(frozen=True, slots=True)
class UpperBodyParameters:
    """Limits of waist, head and arms."""

    waist_speed: float = 1.0  # rad/s; faster throws the robot off balance
    arm_speed: float = 3.0  # rad/s
    head_speed: float = 4.0  # rad/s
    reach: ReachParameters = field(default_factory=ReachParameters)

    def speed_limit(self, joint: str) -> float:
        """The fastest a joint may move, rad/s."""
        part = joint.partition("_")[0]
        return {"waist": self.waist_speed, "head": self.head_speed}.get(part, self.arm_speed)


@dataclass(frozen=True, slots=True)
class WalkerParameters:
    """What the walking controller needs."""

    dimensions: Dimensions
    steps: StepLimits = field(default_factory=StepLimits)
    gait: GaitParameters = field(default_factory=GaitParameters)
    balance: BalanceParameters = field(default_factory=BalanceParameters)
    tipping: TippingParameters = field(default_factory=TippingParameters)

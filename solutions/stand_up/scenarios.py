"""The steps of scenarios for a stand_up server. No expected responses here: this runs in the arena."""

from __future__ import annotations

import math
import threading
import time
from collections import deque
from collections.abc import Sequence

from geometry_msgs.msg import Twist, WrenchStamped
from nav_msgs.msg import Odometry
from rclpy.clock import Clock

from autograder.arena.sequence import Steps, carry_out
from autograder.arena.stage import ActionClient, Goal, Stage
from autograder.arena.units import Metres, Seconds
from humanoid_interfaces.action import StandUp
from humanoid_interfaces.msg import RobotState

ROBOT_TOPICS_TIME = 1.0  # s for the first messages of the robot to arrive
HEIGHT_TIMEOUT = 5.0  # s for the pelvis to reach a height
RESULT_TIMEOUT = 16.0  # s for any result
UNEVEN = 0.5  # the smaller load over the larger, at most, when somebody leans on the robot
LIFT_TIME = 0.5  # s for the feedback to tell a new height of the pelvis
UNEVEN_TIMEOUT = 4.0  # s for the loads to become uneven
NO_VELOCITY = (0.0, 0.0, 0.0)


def in_order(stage: Stage, steps: Steps) -> None:
    """Send goals, cancel them, lean on the robot, push it, make it crouch, in the order of the steps."""
    stand_up = stage.action("stand_up", StandUp)
    stage.open()
    robot = stage.robot
    robot.report_feet()
    robot.wait_for_commands()
    stage.wait(ROBOT_TOPICS_TIME)
    sent: dict[str, Goal] = {}

    def go(name: str) -> None:
        sent[name] = stand_up.send_and_wait(as_=name)

    def go_together(*names: str) -> None:
        sent.update((name, stand_up.send(as_=name)) for name in names)
        for name in names:
            sent[name].wait_for_answer()

    def crouch(height: Metres) -> None:
        robot.take_over(NO_VELOCITY)  # so that the server's commands do not interfere
        robot.move_body(-0.1)
        robot.wait_for(lambda state: state.z < height, HEIGHT_TIMEOUT)
        robot.move_body(0.0)
        robot.give_back()
        robot.wait(ROBOT_TOPICS_TIME)

    def hold(is_held: bool) -> None:
        robot.take_over(NO_VELOCITY) if is_held else robot.give_back()
        robot.wait_for_commands()

    def lean_on(force: float, duration: Seconds) -> None:
        robot.lean_on([0.0, force, 0.0], duration)
        robot.wait_for_feet(lambda left, right: min(left, right) < UNEVEN * max(left, right), UNEVEN_TIMEOUT)

    carry_out(
        stage,
        steps,
        {
            "go": go,
            "go_together": go_together,
            "cancel": lambda name: sent[name].cancel().wait() or None,
            "end": lambda name: sent[name].wait_for_result(RESULT_TIMEOUT) or None,
            "reach": lambda height: robot.wait_for(lambda state: state.z > height, HEIGHT_TIMEOUT) or None,
            "crouch": crouch,
            "hold": hold,
            "lean_on": lean_on,
            "push": lambda *impulse: robot.push(impulse),
            "knock_over": lambda *impulse: robot.knock_over(impulse),
            "wait": stage.wait,
            "interrupt": stage.interrupt_node,
        },
    )


# -- a robot whose topics the scenario simulates -----------------------------------------------------------------------


def ask_before_anything_is_known(stage: Stage) -> None:
    """Send a goal before any message of the robot, and another while a simulated robot crouches."""
    robot = _SimulatedRobot(stage, 0.45)
    stand_up = _open(stage)
    stand_up.send_and_wait(as_="before")
    with robot:
        stage.wait(2 * ROBOT_TOPICS_TIME)
        stand_up.send_and_wait(as_="after")


def sway_before(
    stage: Stage,
    nearly: float,
    light: float,
    even: int,
    uneven: int,
    swings: int,
    rests: float,
    rising: float | None = None,
) -> None:
    """Simulate a robot whose loads are not even at first, then swing from foot to foot, then stay even.

    Args:
        stage: the stage.
        nearly: the right foot's load over the left foot's, at first.
        light: the smaller load over the larger, at the end of a swing.
        even: number of messages with even loads in the middle of each swing.
        uneven: number of messages with uneven loads in each swing.
        swings: number of swings from one side to the other.
        rests: the right foot's load over the left foot's, after the swings.
        rising: the same, as soon as the pelvis rises; by default as after the swings.
    """
    with _SimulatedRobot(stage, 0.45) as robot:
        stand_up = _open(stage)
        robot.change(share=nearly)
        stage.wait(ROBOT_TOPICS_TIME)
        goal = stand_up.send_and_wait(as_="rise")
        stage.wait(ROBOT_TOPICS_TIME)
        for swing in range(swings):
            robot.follow([1.0] * even + [1.0 / light if swing % 2 else light] * uneven)
        stage.poll_until(lambda: robot.has_followed, HEIGHT_TIMEOUT)
        robot.change("even", share=rests)
        if rising is not None:
            stage.poll_until(lambda: robot.z >= BEGUN, HEIGHT_TIMEOUT)
            robot.change(share=rising)
        goal.wait_for_result(RESULT_TIMEOUT)


def step_aside_at_the_top(stage: Stage, light: float, duration: float) -> None:
    """Simulate a robot that rises, puts its weight on one foot for `duration` s, then on both again."""
    with _SimulatedRobot(stage, 0.48) as robot:
        goal = _open(stage).send_and_wait(as_="rise")
        stage.poll_until(lambda: robot.z >= TOP, HEIGHT_TIMEOUT)
        stage.wait(0.2)
        robot.change("uneven", share=light)
        stage.wait(duration)
        robot.change("even", share=1.0)
        goal.wait_for_result(RESULT_TIMEOUT)


def be_restless(
    stage: Stage,
    speed: float,
    tilt: float,
    towards: Sequence[float],
    calm: float,
    duration: float,
    lifted: float = 0.0,
) -> None:
    """Simulate a robot that rises, then glides or leans for a while before it is still and upright.

    Args:
        stage: the stage.
        speed: at which the pelvis glides and bobs, m/s.
        tilt: of the pelvis, rad.
        towards: the directions in which it glides and leans, one after the other, rad in base_link.
        calm: how long it is still and upright after every 0.3 s of motion, s; 0: never.
        duration: of the motion in each direction, s.
        lifted: height by which somebody lifts the pelvis and lowers it again, m, while the loads are not even yet.
    """
    with _SimulatedRobot(stage, 0.48) as robot:
        robot.change(share=0.5 if lifted else 1.0)
        goal = _open(stage).send_and_wait(as_="rise")
        if lifted:
            for height in (lifted, -lifted):
                stage.wait(LIFT_TIME)
                robot.change(z=robot.z + height)
            stage.wait(LIFT_TIME)
            robot.change(share=1.0)
        stage.poll_until(lambda: robot.z >= NEAR_THE_TOP, HEIGHT_TIMEOUT)
        robot.change("restless", speed=speed, tilt=tilt, calm=calm)
        for toward in towards:
            robot.change(toward=toward)
            stage.wait(duration)
        robot.change("calm", speed=0.0, tilt=0.0)
        goal.wait_for_result(RESULT_TIMEOUT)


def never_get_up(stage: Stage, even: float, uneven: float, times: int) -> None:
    """Simulate a robot that is too weak to rise. Its weight moves to one foot several times and finally stays there.

    Args:
        stage: the stage.
        even: duration with the weight on both feet, s.
        uneven: duration with the weight on one foot, s.
        times: number of repetitions.
    """
    with _SimulatedRobot(stage, 0.45, weak=True) as robot:
        goal = _open(stage).send_and_wait(as_="rise")
        for _ in range(times):
            robot.change(share=1.0)
            stage.wait(even)
            robot.change(share=0.3)
            stage.wait(uneven)
        robot.change("uneven", share=0.3)
        goal.wait_for_result(RESULT_TIMEOUT)


def _open(stage: Stage) -> ActionClient:
    stand_up = stage.action("stand_up", StandUp)
    stage.open()
    stage.wait(ROBOT_TOPICS_TIME)
    return stand_up


PERIOD = 0.05  # s between two messages of the simulated robot
WEIGHT = 372.0  # N
BEGUN, NEAR_THE_TOP, TOP, STANCE = 0.47, 0.575, 0.59, 0.60  # m
MOTION_PERIODS = 6  # 0.3 s of motion between two pauses
COMMAND_PERIODS = 10  # 0.5 s, for which a velocity command is valid
BOB = 0.003  # m
BOB_PERIODS = 6


class _SimulatedRobot:
    """Publishes, in a `with` block, the topics of a robot that stands on both feet and rises as cmd_vel commands.

    Args:
        stage: the stage.
        height: of the pelvis at first, m.
        weak: whether it ignores cmd_vel.

    Attributes:
        z: height of the pelvis, m.
        share: the right foot's load over the left foot's.
        speed: at which it glides, m/s; above 0 it also bobs.
        tilt: how far it leans, rad.
        toward: the direction in which it glides and leans, rad in base_link, counter-clockwise from ahead.
        calm: how long speed and tilt are 0 after each 0.3 s of motion, s; 0: never.
    """

    def __init__(self, stage: Stage, height: float, *, weak: bool = False) -> None:
        self.z, self.share, self.speed, self.tilt, self.toward, self.calm = height, 1.0, 0.0, 0.0, 0.0, 0.0
        self._x, self._y, self._weak = 0.0, 0.0, weak
        self._stage = stage
        self._state = stage.offer_topic("robot_state", RobotState, latched=True)
        self._odom = stage.offer_topic("odom", Odometry)
        self._feet = {side: stage.offer_topic(f"{side}_foot/wrench", WrenchStamped) for side in "lr"}
        self._cmd_vel = stage.listen("cmd_vel", Twist)
        self._shares: deque[float] = deque()  # for the next rounds
        self._received, self._rounds_without_command, self._rounds = 0, 0, 0
        self._then = time.monotonic()
        self._changing = threading.Lock()
        self._is_over = False

    def __enter__(self) -> _SimulatedRobot:
        threading.Thread(target=self._live, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        with self._changing:
            self._is_over = True

    def change(self, mark: str = "", **attributes: float) -> None:
        """Set attributes between two rounds of messages, and record a mark at that time for the checks."""
        with self._changing:
            for name, value in attributes.items():
                setattr(self, name, value)
            if mark:
                self._stage.mark(mark)

    def follow(self, shares: Sequence[float]) -> None:
        """Use each of these shares for exactly one of the next rounds, however the threads are scheduled."""
        with self._changing:
            self._shares.extend(shares)

    @property
    def has_followed(self) -> bool:
        return not self._shares

    def _live(self) -> None:
        due = time.monotonic()
        while True:
            with self._changing:
                if self._is_over:
                    return
                self._publish()
            due = max(due + PERIOD, time.monotonic())
            self._stage.wait(due - time.monotonic())

    def _is_calm(self) -> bool:
        """Return whether this round is part of a pause; pauses count rounds, so scheduling does not lengthen them."""
        pause = round(self.calm / PERIOD)
        return self._rounds % (MOTION_PERIODS + pause) >= MOTION_PERIODS

    def _climb(self) -> float:
        """Return the current speed of rising, m/s."""
        received, self._received = self._received, self._cmd_vel.messages
        self._rounds_without_command = 0 if self._received > received else self._rounds_without_command + 1
        if self._weak or self._cmd_vel.latest is None or self._rounds_without_command > COMMAND_PERIODS:
            return 0.0
        rate = self._cmd_vel.latest.linear.z
        is_at_the_top = self.z >= STANCE and rate > 0
        return 0.0 if is_at_the_top or not math.isfinite(rate) else max(-0.15, min(0.15, rate))

    def _publish(self) -> None:
        now = time.monotonic()
        passed, self._then = min(now - self._then, 2 * PERIOD), now
        climb = self._climb()
        self.z = min(STANCE, self.z + climb * passed)
        self._rounds += 1
        if self._shares:
            self.share = self._shares.popleft()
        speed, tilt = (0.0, 0.0) if self._is_calm() else (self.speed, self.tilt)
        ahead, left = math.cos(self.toward), math.sin(self.toward)
        self._x += speed * ahead * passed
        self._y += speed * left * passed
        stamp = Clock().now().to_msg()
        state = RobotState(mode=RobotState.STANDING, motors_enabled=True)
        state.header.stamp = stamp
        odom = Odometry(child_frame_id="base_link")
        odom.header.frame_id, odom.header.stamp = "odom", stamp
        position, orientation = odom.pose.pose.position, odom.pose.pose.orientation
        position.x, position.y = self._x, self._y
        position.z = self.z - (BOB if speed and self._rounds % BOB_PERIODS > 2 else 0.0)
        # The axis of rotation is horizontal and perpendicular to the direction in which it leans.
        orientation.x, orientation.y = -left * math.sin(tilt / 2), ahead * math.sin(tilt / 2)
        orientation.w = math.cos(tilt / 2)
        velocity = odom.twist.twist.linear
        velocity.x, velocity.y, velocity.z = speed * ahead, speed * left, climb
        carried = WEIGHT / (1.0 + self.share)
        for side, load in (("l", carried), ("r", WEIGHT - carried)):
            wrench = WrenchStamped()
            wrench.header.frame_id, wrench.header.stamp = f"{side}_sole", stamp
            wrench.wrench.force.z = load
            self._feet[side].publish(wrench)
        self._odom.publish(odom)
        self._state.publish(state)

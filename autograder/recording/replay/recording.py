"""Reads a recording: the robot's postures, the events, and the verdicts."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path
from typing import IO, Any

from mcap.reader import make_reader
from rcl_interfaces.msg import Log
from rclpy.serialization import deserialize_message

from autograder.recording.definitions import class_of
from autograder.recording.entry import CHECKS, EVENTS, FORMAT, METADATA, ROSOUT
from autograder.recording.narration import brief
from ros_runtime.course_error import CourseError

MAX_FILE_BYTES = 128 * 2**20
MAX_MESSAGES = 500_000
SPAN_LENGTH = 6.0  # s shown around a verdict
SHARE_BEFORE_VERDICT = 2 / 3  # share of these seconds that is before the verdict


class UnusableRecording(CourseError):
    """The file cannot be shown; the message says what was found and what to do."""


@dataclass(frozen=True)
class Posture:
    """The whole robot at time `t` (s): poses are x, y, z (m) and a quaternion (x, y, z, w), joints rad (fingers: m)."""

    t: float
    base: Sequence[float]
    joints: Sequence[float]
    objects: Mapping[str, Sequence[float]]


class Kind(Enum):
    """The kind of a moment."""

    EVENT = "event"
    FEEDBACK = "feedback"
    OUTPUT = "output"
    PASSED = "passed"
    FAILED = "failed"
    WARNING = "warning"


@dataclass(frozen=True)
class Moment:
    """An event, a line of output or a verdict at `t` (s, arena's clock); `check`: the verdict's check, else ""."""

    t: float
    kind: Kind
    text: str
    check: str = ""


@dataclass(frozen=True)
class Recording:
    """The content of a file of `course grade --record` or `course check --record`.

    Attributes:
        path: path of the file.
        about: the recording's metadata, such as exercise, student and scenario.
        joints: names of the joints in the postures.
        postures: in order of time, 25 per second of the arena's clock; empty without a robot.
        moments: events, output and the verdicts of the checks that judged this run, in order of time.
    """

    path: Path
    about: Mapping[str, str]
    joints: Sequence[str]
    postures: Sequence[Posture] = field(repr=False)
    moments: Sequence[Moment] = field(repr=False)

    @classmethod
    def read(cls, path: Path) -> Recording:
        """Read a file; raises the same as `parsed`."""
        _require_a_small_file(path)
        with path.open("rb") as file:
            return cls.parsed(file, path)

    @classmethod
    def parsed(cls, file: IO[bytes], path: Path) -> Recording:
        """Read an open file.

        Raises:
            UnusableRecording: the file is not a recording, is damaged, or was written by another version.
        """
        try:
            reader = make_reader(file, validate_crcs=True)
            about = _metadata(path, reader.iter_metadata())
            collected = _Collected(about["namespace"])
            for number, (schema, channel, message) in enumerate(reader.iter_messages()):
                if number >= MAX_MESSAGES:
                    raise UnusableRecording(
                        f"{path} holds more than {MAX_MESSAGES:,} messages, too many to show"
                    )
                if schema:
                    collected.add(message.log_time / 1e9, channel.topic, schema.name, message.data)
        except UnusableRecording:
            raise
        except Exception as error:  # three libraries raise different errors for malformed bytes
            raise UnusableRecording(
                f"{path} is not a recording of an arena, or it is damaged ({type(error).__name__}: {error}); expected "
                "an MCAP file that `course grade --record` or `course check --record` wrote"
            ) from error
        return cls(path, about, collected.joints, list(collected.postures()), collected.moments)

    @property
    def end(self) -> float:
        """When the scenario ended, s."""
        return float(self.about["end"])

    @property
    def first_failed(self) -> Moment | None:
        """The failed check with the earliest time, or None."""
        failed = [moment for moment in self.moments if moment.kind is Kind.FAILED]
        return min(failed, key=lambda moment: moment.t, default=None)

    def verdict(self, check: str) -> Moment:
        """Return the verdict of a check.

        Raises:
            UnusableRecording: the check did not judge this run; the message lists the checks that did.
        """
        verdicts = {moment.check: moment for moment in reversed(self.moments) if moment.check}
        if check in verdicts:
            return verdicts[check]
        known = ", ".join(reversed(verdicts)) or "none"
        raise UnusableRecording(f"no check {check!r} judged this run; the checks that did are {known}")


def recordings_in(files: Mapping[str, bytes]) -> list[Recording]:
    """Return the recordings of files that are not written to disk, by their names; raises the same as `parsed`."""
    return [Recording.parsed(io.BytesIO(content), Path(name)) for name, content in sorted(files.items())]


class _Collected:
    """Collects postures and moments from the messages of a file."""

    def __init__(self, namespace: str) -> None:
        self._own = f"{namespace.rstrip('/')}/"
        self._odom: dict[float, Sequence[float]] = {}
        self._positions: dict[float, Sequence[float]] = {}
        self._objects: dict[float, dict[str, Sequence[float]]] = {}
        self.joints: Sequence[str] = ()
        self.moments: list[Moment] = []

    def add(self, t: float, topic: str, type_name: str, data: bytes) -> None:
        """Add one message."""
        own = topic.removeprefix(self._own)
        if topic in (EVENTS, ROSOUT):
            self._log(t, topic, deserialize_message(data, Log))
        elif own == "odom" and type_name == "nav_msgs/msg/Odometry":
            self._odom[t] = _place(deserialize_message(data, class_of(type_name)).pose.pose)
        elif own == "joint_states" and type_name == "sensor_msgs/msg/JointState":
            message = deserialize_message(data, class_of(type_name))
            self.joints = self.joints or list(message.name)
            if list(message.name) == self.joints:
                self._positions[t] = list(message.position)
        elif own.startswith("objects/") and type_name == "geometry_msgs/msg/PoseStamped":
            message = deserialize_message(data, class_of(type_name))
            self._objects.setdefault(t, {})[own.split("/")[1]] = _place(message.pose)
        elif topic.endswith("/_action/feedback"):
            feedback = deserialize_message(data, class_of(type_name)).feedback
            action = own.removesuffix("/_action/feedback")
            self.moments.append(
                Moment(t, Kind.FEEDBACK, readable(f"feedback of {action}: {brief(feedback)}"))
            )

    def postures(self) -> Iterator[Posture]:
        """Yield the complete postures."""
        for t, base in sorted(self._odom.items()):
            joints = self._positions.get(t, ())
            if len(joints) == len(self.joints):
                yield Posture(t, base, joints, self._objects.get(t, {}))

    def _log(self, t: float, topic: str, line: Log) -> None:
        text = readable(line.msg)
        if topic == EVENTS:
            self.moments.append(Moment(t, Kind.EVENT if line.level < Log.WARN else Kind.WARNING, text))
        elif line.name == CHECKS:
            kind = {Log.ERROR: Kind.FAILED, Log.INFO: Kind.PASSED}.get(line.level, Kind.WARNING)
            self.moments.append(Moment(t, kind, text, line.function))
        else:
            self.moments.append(Moment(t, Kind.OUTPUT, readable(f"{line.name}: {line.msg}")))


def _place(pose: Any) -> Sequence[float]:
    at, turned = pose.position, pose.orientation
    return (at.x, at.y, at.z, turned.x, turned.y, turned.z, turned.w)


def _require_a_small_file(path: Path) -> None:
    try:
        size = path.stat().st_size if path.is_file() else None
    except OSError as error:
        raise UnusableRecording(f"{path} cannot be read: {error}") from error
    if size is None:
        raise UnusableRecording(
            f"{path} is not a file; give an .mcap file, such as recordings/walk_to/walk.mcap"
        )
    if size > MAX_FILE_BYTES:
        raise UnusableRecording(
            f"{path} has {size / 2**20:.0f} MiB; a recording has at most {MAX_FILE_BYTES // 2**20} MiB"
        )


def _metadata(path: Path, records: Iterator[Any]) -> Mapping[str, str]:
    about = next((record.metadata for record in records if record.name == METADATA), None)
    if about is None:
        raise UnusableRecording(
            f"{path} is an MCAP file, but not a recording of an arena; open it with Foxglove or another viewer"
        )
    if about.get("format") != FORMAT:
        raise UnusableRecording(
            f"{path} was written by another version (format {about.get('format', 'unknown')!s:.20}; this version "
            f"reads {FORMAT}): show it with that version, or record it again"
        )
    return about


def readable(text: str) -> str:
    """Return the text in one line without control characters, which a program may have printed to move the cursor."""
    return "".join(letter if letter.isprintable() else " " for letter in text)


@dataclass(frozen=True)
class Span:
    """The part of a recording from `start` to `end`, s on the arena's clock."""

    start: float
    end: float


def span_of(recording: Recording, around: str | None, seconds: float | None) -> Span:
    """Return the part to show: around a check's verdict, by default around the first failed check, else everything.

    Args:
        recording: the recording.
        around: the check's id, or None.
        seconds: length of the part, or None; if no check failed, the part starts at the beginning.

    Raises:
        ValueError: the duration is not positive.
    """
    if seconds is not None and not seconds > 0:
        raise ValueError(f"--seconds is {seconds:g}; expected a positive number")
    verdict = recording.verdict(around) if around else recording.first_failed
    if verdict is None:
        return Span(0.0, min(recording.end, seconds or recording.end))
    length = min(seconds or SPAN_LENGTH, recording.end)
    start = min(max(0.0, verdict.t - SHARE_BEFORE_VERDICT * length), recording.end - length)
    return Span(start, start + length)


def require_postures(recording: Recording) -> None:
    """Require that the recording has postures of a robot."""
    if not recording.postures:
        raise UnusableRecording(
            f"the scenario {recording.about['scenario']} has no robot, so none was recorded; --text shows the events"
        )

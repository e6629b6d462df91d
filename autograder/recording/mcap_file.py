"""Writes an MCAP file of limited size in memory, so that a student's messages cannot fill the disk."""

from __future__ import annotations

import io
import logging
from collections.abc import Iterable, Mapping

from mcap.well_known import MessageEncoding, SchemaEncoding
from mcap.writer import CompressionType, Writer
from rcl_interfaces.msg import Log

from autograder.recording.cdr import serialize
from autograder.recording.definitions import definition
from autograder.recording.entry import EVENTS, METADATA, Entry, as_nanoseconds
from autograder.recording.log_messages import log
from ros_runtime.messages import type_name

MAX_MESSAGE_BYTES = 2**18  # of one non-essential message
MAX_NONESSENTIAL_BYTES = 6 * 2**20  # of all non-essential messages, before compression
MAX_TOPICS = 200  # a non-essential message on a further topic is left out
CHUNK_BYTES = 2**18


def mcap_file(entries: Iterable[Entry], metadata: Mapping[str, str]) -> bytes:
    """Return messages as an MCAP file of profile "ros2", compressed with zstd.

    The size of non-essential messages is limited. Messages beyond the limit are left out, and a message on
    /arena/events marks the first of them.
    """
    out = io.BytesIO()
    file = _File(out)
    file.begin(metadata)
    for entry in sorted(entries, key=lambda entry: entry.t):
        file.add(entry)
    file.finish()
    return out.getvalue()


class _File:
    def __init__(self, out: io.BytesIO) -> None:
        self._writer = Writer(out, chunk_size=CHUNK_BYTES, compression=CompressionType.ZSTD)
        self._schemas: dict[str, int] = {}
        self._channels: dict[tuple[str, str], int] = {}
        self._sequence: dict[int, int] = {}
        self._nonessential_bytes = 0
        self._left_out = 0

    def begin(self, metadata: Mapping[str, str]) -> None:
        self._writer.start(profile="ros2", library="course")
        self._writer.add_metadata(METADATA, dict(metadata))

    def add(self, entry: Entry) -> None:
        try:
            data = serialize(entry.message)
            self._schema(type_name(entry.message))
        except Exception:  # this message cannot be serialized; the others are still written
            logging.getLogger(__name__).debug("left out: a message on %s", entry.topic, exc_info=True)
            self._leave_out(entry.t)
            return
        if entry.essential or self._fits(entry, len(data)):
            self._write(entry, data)
        else:
            self._leave_out(entry.t)

    def finish(self) -> None:
        self._writer.finish()

    def _fits(self, entry: Entry, size: int) -> bool:
        new_topic = (entry.topic, type_name(entry.message)) not in self._channels
        if (
            size > MAX_MESSAGE_BYTES
            or self._nonessential_bytes + size > MAX_NONESSENTIAL_BYTES
            or (new_topic and len(self._channels) >= MAX_TOPICS)
        ):
            return False
        self._nonessential_bytes += size
        return True

    def _leave_out(self, t: float) -> None:
        self._left_out += 1
        if self._left_out == 1:
            text = "some messages are left out from here on: too many, too large, or not serializable"
            message = log(t, Log.WARN, "recording", text)
            self._write(Entry(t, EVENTS, message, essential=True), serialize(message))

    def _write(self, entry: Entry, data: bytes) -> None:
        channel = self._channel(entry.topic, type_name(entry.message))
        self._sequence[channel] = self._sequence.get(channel, 0) + 1
        at = as_nanoseconds(entry.t)
        self._writer.add_message(channel, at, data, publish_time=at, sequence=self._sequence[channel])

    def _channel(self, topic: str, of_type: str) -> int:
        key = topic, of_type
        if key not in self._channels:
            self._channels[key] = self._writer.register_channel(
                topic, MessageEncoding.CDR, self._schema(of_type)
            )
        return self._channels[key]

    def _schema(self, of_type: str) -> int:
        if of_type not in self._schemas:
            text = definition(of_type).encode()
            self._schemas[of_type] = self._writer.register_schema(of_type, SchemaEncoding.ROS2, text)
        return self._schemas[of_type]

"""Makes the definition of a message type for MCAP files: the .msg text of the type and of all its nested types.

The text is derived from the generated classes, because feedback messages and service events have no .msg file.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from typing import Any

from geometry_msgs.msg import TransformStamped

from ros_runtime.messages import message_type

_SEPARATOR = "=" * 80
_NAMES = {
    "boolean": "bool",
    "double": "float64",
    "float": "float32",
    "octet": "byte",
}  # names of types in IDL and in .msg files
_SEQUENCE = re.compile(r"sequence<(.+?)(?:, (\d+))?>")
_ARRAY = re.compile(r"(.+)\[(\d+)\]")
_BOUNDED_TEXT = re.compile(r"(w?string)<(\d+)>")
_IN_IMPL = ("FeedbackMessage", "SendGoal", "GetResult")  # types that are in an action's nested class `Impl`
TF_TYPE = "tf2_msgs/msg/TFMessage"


class TFMessage:
    """The message TF_TYPE, which the ROS wheels lack; it has only the members that serialization needs."""

    __module__ = (
        "tf2_msgs.msg._tf_message"  # the generated class has this module, from which its type is read
    )

    def __init__(self, transforms: Sequence[TransformStamped] = ()) -> None:
        self.transforms = list(transforms)

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]:
        """Return the fields with their types, as a generated message class does."""
        return {"transforms": "sequence<geometry_msgs/TransformStamped>"}


@cache
def definition(type_name: str) -> str:
    """Return the definition of a type such as 'nav_msgs/msg/Odometry', for MCAP's encoding "ros2msg".

    Raises:
        ValueError: there is no such type.
    """
    fields = _fields(type_name)
    texts = [_text(fields)]
    defined: set[str] = set()
    open_types = list(_nested(fields, type_name))
    while open_types:
        name = open_types.pop(0)
        if name in defined:
            continue
        defined.add(name)
        fields = _fields(name)
        package, _, short = name.split("/")
        texts.append(f"{_SEPARATOR}\nMSG: {package}/{short}\n{_text(fields)}")
        open_types += _nested(fields, name)
    return "\n".join(texts)


def class_of(type_name: str) -> Any:
    """Return the generated class of a type, which may also be a part of a service or an action.

    Raises:
        ValueError: there is no such type.
    """
    if type_name == TF_TYPE:
        return TFMessage
    package, _, rest = type_name.partition("/")
    kind, _, name = rest.partition("/")
    interface, _, part = name.partition("_")
    if kind == "msg" or not part:
        return message_type(type_name)
    found: Any = message_type(f"{package}/{kind}/{interface}")
    try:
        if part.startswith(_IN_IMPL):
            inner, _, last = part.partition("_")
            found = getattr(found.Impl, inner if inner == "FeedbackMessage" else f"{inner}Service")
            return getattr(found, last) if last else found
        return getattr(found, part)
    except AttributeError as error:
        raise ValueError(f"there is no message type {type_name[:100]!r}: {error}") from error


def _fields(type_name: str) -> Mapping[str, str]:
    return class_of(type_name).get_fields_and_field_types()


def _text(fields: Mapping[str, str]) -> str:
    return "\n".join(f"{_type_text(declared)} {name}" for name, declared in fields.items())


def _type_text(declared: str) -> str:
    if match := _SEQUENCE.fullmatch(declared):
        return f"{_type_text(match[1])}[{f'<={match[2]}' if match[2] else ''}]"
    if match := _ARRAY.fullmatch(declared):
        return f"{_type_text(match[1])}[{match[2]}]"
    if match := _BOUNDED_TEXT.fullmatch(declared):
        return f"{match[1]}<={match[2]}"
    return _NAMES.get(declared, declared)


def _nested(fields: Mapping[str, str], of: str) -> Iterator[str]:
    """Return the full names of the fields' message types, such as 'std_msgs/msg/Header'."""
    _, kind, _ = of.split("/")
    for declared in fields.values():
        plain = _type_text(declared).split("[")[0]
        if "/" in plain:
            package, name = plain.split("/")
            yield f"{package}/{kind if '_' in name else 'msg'}/{name}"

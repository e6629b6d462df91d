"""Explains in plain words what is wrong with a line of a definition, and what was expected there."""

from __future__ import annotations

import keyword
import re
from difflib import get_close_matches
from typing import Any, NamedTuple

from rosidl_adapter.parser import PRIMITIVE_TYPES, is_valid_constant_name, is_valid_field_name

from ros_runtime.interface_build.known_types import KnownTypes

# Types that people write out of habit from Python, C++ or ROS 1, and the correct types.
FOREIGN_TYPES = {
    "float": "float64",
    "double": "float64",
    "real": "float64",
    "int": "int32",
    "integer": "int32",
    "long": "int64",
    "uint": "uint32",
    "boolean": "bool",
    "str": "string",
    "text": "string",
    "bytes": "uint8[]",
    "list": "float64[]",
    "time": "builtin_interfaces/Time",
    "duration": "builtin_interfaces/Duration",
}
# Field names become members of C and C++ structures, so these words cannot be names.
C_AND_CPP_KEYWORDS = """
    alignas alignof and asm auto bitand bitor bool break case catch char class compl const constexpr continue decltype
    default delete do double else enum explicit export extern false float for friend goto if inline int long mutable
    namespace new noexcept not nullptr operator or private protected public register restrict return short signed
    sizeof static struct switch template this throw true try typedef typeid typename union unsigned using virtual void
    volatile while xor
"""


class Finding(NamedTuple):
    """What is wrong, and what was expected."""

    wrong: str
    expected: str


def name_is_reserved(name: str) -> bool:
    """Return whether a field of this name would not compile, or could not be written as `message.name`."""
    return name in C_AND_CPP_KEYWORDS.split() or keyword.iskeyword(name)


def explain_line(text: str, complaint: str, known: KnownTypes) -> Finding:
    """Return why rosidl's parser refused a line with `complaint`."""
    type_name, _, rest = text.partition(" ")
    name, equals, value = (part.strip() for part in rest.partition("="))
    name = name.split(" ")[0]
    if text.startswith(" "):
        return Finding("the line is indented", f"no space in front:  {text.strip()}")
    if text.endswith((";", ",")):
        return Finding(f"the line ends with {text[-1]!r}", f"nothing after the name:  {text[:-1]}")
    if ":" in type_name + name:
        return Finding("there is a colon, as in Python", "the type, a space, the name:  float64 speed")
    if not rest:
        return Finding("the line has only one word", "a type and a name:  float64 speed")
    if finding := _explain_spelling(type_name, known):
        return finding
    if equals and not is_valid_constant_name(name):
        wanted = "capitals, digits and single _, with no space in it:  NO_SOLUTION=-31"
        return Finding(f"{name!r} cannot be the name of a constant", wanted)
    if not equals and not is_valid_field_name(name):
        return Finding(
            f"{name!r} cannot be the name of a field",
            f"small letters, digits and single _, a letter first:  {type_name} {_snake_case(name)}",
        )
    return Finding(complaint, f"a value of type {type_name}" if value or " " in rest else "TYPE NAME")


def explain_type(field_type: Any, package: str, known: KnownTypes) -> Finding | None:
    """Return why the build will not find the type of a correctly spelled field; None if it will find it."""
    if field_type.is_primitive_type():
        return _explain_spelling(field_type.type, known) if field_type.type in FOREIGN_TYPES else None
    wanted, name = field_type.pkg_name, field_type.type
    if known.has(wanted, name):
        return None
    if wanted == package:
        return Finding(
            f"{name} is neither a basic type nor a .msg of this package", _probable_type(name, known)
        )
    if wanted not in known.packages:
        similar = _similar(wanted, known.packages) or "a package that is installed, such as geometry_msgs"
        return Finding(f"there is no package {wanted} with messages", similar)
    here = _similar(name, known.packages[wanted])
    return Finding(
        f"{wanted} has no message {name}", f"{wanted}/{here}" if here else _probable_type(name, known)
    )


def _explain_spelling(type_name: str, known: KnownTypes) -> Finding | None:
    """Return what is wrong with the spelling of a line's first word."""
    bare, bracket, size = type_name.partition("[")
    parts = bare.split("/")
    if bracket and not re.fullmatch(r"(<=)?\d*\]", size):
        return Finding(
            f"[{size} is not an array size",
            "after the type: [] for any size, [3] for three, [<=3] for at most three",
        )
    if bare in FOREIGN_TYPES:
        return Finding(f"{bare} is not a type of ROS 2", FOREIGN_TYPES[bare] + type_name[len(bare) :])
    if len(parts) == 3:
        return Finding(
            f"{bare} has a folder in the middle",
            f"{parts[0]}/{parts[2]}: the type of a field is always a message",
        )
    if len(parts) > 2 or "." in bare:
        words = re.split(r"[./]", bare)
        return Finding(f"{bare} is not a type", f"the package, a slash, the message:  {words[0]}/{words[-1]}")
    if len(parts) == 1 and bare not in PRIMITIVE_TYPES and not bare.startswith(("string<=", "wstring<=")):
        return Finding(f"{bare} is not a basic type", _probable_type(bare, known))
    return None


def _probable_type(name: str, known: KnownTypes) -> str:
    """Return the type that the student probably meant by `name`, which has no package or a wrong one."""
    if name.lower() in PRIMITIVE_TYPES:
        return name.lower()
    if packages := known.packages_with(name):
        return " or ".join(f"{package}/{name}" for package in packages)
    return _similar(name, PRIMITIVE_TYPES) or "float64, int32, bool, string, … or package/Type"


def _similar(word: str, words: Any) -> str:
    """Return the word of `words` that is most similar to `word`, or ""."""
    return next(iter(get_close_matches(word, list(words), n=1, cutoff=0.75)), "")


def _snake_case(name: str) -> str:
    """Return a name in snake case: NumSteps becomes num_steps."""
    spaced = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
    return re.sub(r"_+", "_", re.sub(r"[^a-z0-9_]", "_", spaced)).strip("_0123456789") or "name"

"""The problems reported for definitions that cannot be built, and the content read from valid ones."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from ros_runtime.environment import uses_wheels
from ros_runtime.interface_build.definitions import InvalidDefinitions, Problem, read_definitions
from ros_runtime.interface_build.known_types import KnownTypes

PREFIXES = [sys.prefix] if uses_wheels() else os.environ["AMENT_PREFIX_PATH"].split(os.pathsep)
KNOWN = KnownTypes.installed([Path(prefix) for prefix in PREFIXES])


def problems_of(folder: Path, **files: str) -> list[Problem]:
    """The problems of files given as Name__srv="…"."""
    for name, text in files.items():
        (folder / name.replace("__", ".")).write_text(text)
    with pytest.raises(InvalidDefinitions) as caught:
        read_definitions(folder, "my_interfaces", KNOWN)
    return caught.value.problems


WRONG_LINES = [
    ("float speed", "float is not a type of ROS 2", "float64"),
    ("float[3] axis", "float is not a type of ROS 2", "float64[3]"),
    ("Float64 speed", "neither a basic type nor a .msg of this package", "float64"),
    ("flaot64 speed", "not a basic type", "float64"),
    ("time when", "time is not a type of ROS 2", "builtin_interfaces/Time"),
    ("Point target", "neither a basic type nor a .msg of this package", "geometry_msgs/Point"),
    ("geometry_msgs/msg/Point target", "a folder in the middle", "geometry_msgs/Point"),
    ("geometry_msgs.Point target", "is not a type", "geometry_msgs/Point"),
    ("geometry_msgs/Pont target", "geometry_msgs has no message Pont", "geometry_msgs/Point"),
    ("std_msgs/Point target", "std_msgs has no message Point", "geometry_msgs/Point"),
    ("geometri_msgs/Point target", "there is no package geometri_msgs", "geometry_msgs"),
    ("float64[x] speeds", "[x] is not an array size", "[3]"),
    ("list[float64] speeds", "[float64] is not an array size", "[3]"),
    ("float64 maxSpeed", "'maxSpeed' cannot be the name of a field", "float64 max_speed"),
    ("float64 max__speed", "'max__speed' cannot be the name of a field", "float64 max_speed"),
    ("float64 2nd", "'2nd' cannot be the name of a field", "float64 nd"),
    ("float64 class", "class is a keyword of C, C++ or Python", "class_value"),
    ("float64 from", "from is a keyword of C, C++ or Python", "from_value"),
    ("int32 none=0", "'none' cannot be the name of a constant", "capitals"),
    ("int8 MANY=300", "must be a valid integer value >= -128 and <= 127", "int8"),
    ("bool ready maybe", "must be either 'true'", "bool"),
    ("float64", "the line has only one word", "float64 speed"),
    (" float64 speed", "the line is indented", "float64 speed"),
    ("float64 speed;", "ends with ';'", "float64 speed"),
    ("speed: float64", "a colon, as in Python", "float64 speed"),
]


@pytest.mark.parametrize(("line", "wrong", "expected"), WRONG_LINES, ids=[line for line, _, _ in WRONG_LINES])
def test_a_wrong_line_is_named_with_what_was_expected(
    tmp_path: Path, line: str, wrong: str, expected: str
) -> None:
    (problem,) = problems_of(tmp_path, Speed__msg=f"# m/s\nint32 first\n{line}\nint32 last\n")
    assert (problem.file, problem.line, problem.text.strip()) == ("Speed.msg", 3, line.strip())
    assert wrong in problem.wrong
    assert expected in problem.expected


@pytest.mark.parametrize("separator", ["--", "----", " ---", "--- ", "---  # response"])
def test_a_line_that_only_looks_like_a_separator_is_named(tmp_path: Path, separator: str) -> None:
    near_miss, count = problems_of(tmp_path, Go__srv=f"int32 a\n{separator}\nint32 b\n")
    assert (near_miss.line, near_miss.text, near_miss.wrong) == (2, separator, "this is not a separator")
    assert count.wrong == "it has 0 lines that are exactly ---"
    assert count.expected == "1: a .srv is request --- response, and each may be empty"


@pytest.mark.parametrize(
    ("file", "count"), [("Go__srv", 0), ("Go__srv", 2), ("Go__action", 1), ("Go__msg", 1)]
)
def test_the_separators_are_counted(tmp_path: Path, file: str, count: int) -> None:
    (problem,) = problems_of(tmp_path, **{file: "int32 a\n" + "---\n" * count})
    assert problem.line == 0
    assert problem.wrong == f"it has {count} lines that are exactly ---"


def test_a_name_is_unique_in_a_part_but_may_recur_in_the_next(tmp_path: Path) -> None:
    (problem,) = problems_of(tmp_path, Go__srv="int32 a\nfloat64 a\n---\nint32 a\n")
    assert (problem.line, problem.wrong) == (2, "this part already has a a")


@pytest.mark.parametrize("name", ["compute_ik", "goHome", "2Go"])
def test_a_files_name_must_be_a_type_name(tmp_path: Path, name: str) -> None:
    (problem,) = problems_of(tmp_path, **{f"{name}__msg": "int32 a\n"})
    assert problem.wrong == f"'{name}' cannot be the name of a type"
    assert problem.expected.startswith("a name such as ")


def test_all_problems_of_all_files_are_reported_at_once(tmp_path: Path) -> None:
    found = problems_of(tmp_path, Go__srv="int a\n---\nfloat b\n", Level__msg="int32 Level\n")
    assert [(problem.file, problem.line) for problem in found] == [
        ("Go.srv", 1),
        ("Go.srv", 3),
        ("Level.msg", 1),
    ]


def test_an_empty_folder_and_a_file_that_is_not_text_are_named(tmp_path: Path) -> None:
    (nothing,) = problems_of(tmp_path)
    assert nothing.wrong == "there is no definition in this folder"
    (tmp_path / "Go.msg").write_bytes(b"int32 a\n\xff\xfe")
    (binary,) = problems_of(tmp_path)
    assert "not UTF-8 text" in binary.wrong


def test_two_files_of_one_name_are_refused(tmp_path: Path) -> None:
    (tmp_path / "msg").mkdir()
    (tmp_path / "msg/Go.msg").write_text("int32 a\n")
    (problem,) = problems_of(tmp_path, Go__msg="int32 a\n")
    assert problem.wrong == "the folder has two files of this name"


def test_a_valid_definition_is_read_with_fields_constants_and_packages(tmp_path: Path) -> None:
    (tmp_path / "action").mkdir()
    (tmp_path / "action/Go.action").write_text(
        '# Go there.\nWaypoint[<=3] via  # m\ngeometry_msgs/PoseStamped pose\nstring<=8 mode "walk"\n'
        "---\nuint16 NONE=0\nuint16 FELL=1  # down\nuint16 error_code\n---\n"
    )
    (tmp_path / "Waypoint.msg").write_text("float64[2] position")
    waypoint, go = read_definitions(tmp_path, "my_interfaces", KNOWN)
    assert (go.kind, go.name, go.uses) == ("action", "Go", {"my_interfaces", "geometry_msgs"})
    assert go.parts["goal"].fields == {
        "via": "my_interfaces/Waypoint[<=3]",
        "pose": "geometry_msgs/PoseStamped",
        "mode": "string<=8",
    }
    assert go.parts["result"].constants == {"NONE": ("uint16", 0), "FELL": ("uint16", 1)}
    assert go.parts["feedback"].fields == {}
    assert waypoint.parts["message"].fields == {"position": "float64[2]"}


TOO_MUCH = [
    ("".join(f"int field_{number}\n" for number in range(4313)), "it has 4,313 lines"),
    ("".join(f"int32 field_{number}\n" for number in range(101)), "it has 101 fields and constants"),
    ("# " + "x" * 70_000, "it has 70,002 bytes"),
    ("int32 " + "a" * 600, "the line has 606 characters"),
]


@pytest.mark.parametrize(("text", "wrong"), TOO_MUCH, ids=[wrong for _, wrong in TOO_MUCH])
def test_a_file_that_is_too_large_to_build_is_refused(tmp_path: Path, text: str, wrong: str) -> None:
    first, *_ = problems_of(tmp_path, Go__msg=text)
    assert first.wrong == wrong
    assert first.expected.startswith("at most ")

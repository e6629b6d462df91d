"""Texts that students write: designs of essays, and interface files."""

from __future__ import annotations

import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from hypothesis import strategies as st

from autograder.engine.essay import load_essay, unmarked_grade
from autograder.engine.exercise import file_names
from fuzz import strategies as odd
from fuzz.fuzzer import Fuzzer
from ros_runtime.interface_build.definitions import InvalidDefinitions, read_definitions
from ros_runtime.interface_build.known_types import KnownTypes

LONGEST_PICTURE = 2_000_000  # characters of SVG
MOST_PROBLEMS = 1200
ESSAY = "arm_architecture"


def require_picture_or_none(text: str) -> None:
    """Require that an essay is drawn as SVG that a browser reads, or not drawn, and that a person has to mark it."""
    essay = load_essay(ESSAY)
    assert essay.picture is not None
    svg = essay.picture(dict.fromkeys(file_names(ESSAY), text))
    if svg is not None:
        assert len(svg) < LONGEST_PICTURE
        ElementTree.fromstring(svg)
        assert "<script" not in svg.lower()
    grade = unmarked_grade(essay, "anna")
    assert grade.status == "to mark"
    assert grade.score is None


def require_definitions_or_problems(drawn: tuple[str, bytes]) -> None:
    """Require that an interface file is read, or that each of its problems is reported."""
    name, data = drawn
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, name).write_bytes(data)
        try:
            definitions = read_definitions(Path(folder), "student_interfaces", _KNOWN)
        except InvalidDefinitions as error:
            assert 0 < len(error.problems) <= MOST_PROBLEMS
            assert all(problem.wrong and problem.expected for problem in error.problems)
        else:
            assert len(definitions) == 1


_KNOWN = KnownTypes({"geometry_msgs": frozenset({"Pose"})})
_words = st.one_of(
    odd.texts, st.sampled_from(("camera", "arm", "topic", "service", "wire", "std_msgs/msg/Empty", "#"))
)
_links = st.tuples(_words, _words, _words, _words).map(lambda w: f"{w[0]} -> {w[1]} : {w[2]} {w[3]}")
_facts = st.tuples(st.sampled_from(("qos", "rate", "failure", "safety", "fields")), odd.texts).map(": ".join)
_designs = st.lists(st.one_of(_links, _facts.map("    {}".format), odd.texts), max_size=80).map("\n".join)
_types = [
    "bool",
    "float64",
    "string<=5",
    "uint8[3]",
    "int32[<=4]",
    "geometry_msgs/Pose",
    "no_such/Type",
    "char",
]
_field_names = ("x", "X=3", "y 1.5", "class", 'z "a', "_", "a b c", "s 'é'")
_fields = st.tuples(
    st.one_of(st.sampled_from(_types), odd.texts),
    st.sampled_from((" ", "  ", "\t", "=", "[")),
    st.one_of(st.sampled_from(_field_names), odd.texts),
).map("".join)
_files = ("GetBatteryStatus.srv", "NavigateToPose.action", "State.msg", "a_b.msg", "1.srv")
_texts = st.lists(st.one_of(_fields, st.just("---"), odd.texts), max_size=30).map("\n".join)
_contents = st.one_of(_texts.map(lambda text: text.encode(errors="surrogatepass")), odd.blobs)
_definitions = st.tuples(st.sampled_from(_files), _contents)

FUZZERS = (
    Fuzzer("files-essay", "files", _designs, require_picture_or_none),
    Fuzzer("files-interfaces", "files", _definitions, require_definitions_or_problems),
)

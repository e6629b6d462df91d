"""The built interfaces have exactly the fields and constants that other people's code relies on."""

from __future__ import annotations

import subprocess
import sys
from functools import reduce
from importlib import import_module
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml

ROOT = Path(__file__).resolve().parents[3]
SOURCE = ROOT / "humanoid_interfaces"

# interfaces.yaml has the fields and constants by the name of the interface and its part: srv/ComputeIK.Request
KEPT = yaml.safe_load(Path(__file__).with_name("interfaces.yaml").read_text(encoding="utf-8"))


def type_of(name: str) -> type:
    """Return the generated class of an interface or of its part."""
    kind, _, path = name.partition("/")
    return reduce(getattr, path.split("."), import_module(f"humanoid_interfaces.{kind}"))


def declared_constants(message_type: type) -> dict[str, object]:
    """The constants of a generated class: the upper-case names of its metaclass."""
    metaclass = type(message_type)
    return {
        name: getattr(message_type, name) for name in vars(metaclass) if name.isupper() and name[0] != "_"
    }


@pytest.mark.parametrize("name", KEPT["fields"])
def test_fields_in_their_order_and_constants(name: str) -> None:
    message_type = type_of(name)
    assert list(message_type.get_fields_and_field_types().items()) == list(KEPT["fields"][name].items())
    assert declared_constants(message_type) == KEPT["constants"].get(name, {})


def test_every_source_file_is_tested_and_in_the_cmake_list() -> None:
    sources = {
        str(path.relative_to(SOURCE))
        for kind in ("msg", "srv", "action")
        for path in SOURCE.glob(f"{kind}/*")
    }
    cmake = (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8")
    assert {source.partition(".")[0] for source in sources} == {
        name.partition(".")[0] for name in KEPT["fields"]
    }
    assert [source for source in sources if f'"{source}"' not in cmake] == []


def test_the_folder_is_a_stock_ros_package() -> None:
    package = ElementTree.parse(SOURCE / "package.xml").getroot()

    assert package.get("format") == "3"
    assert package.findtext("name") == "humanoid_interfaces"
    assert package.findtext("member_of_group") == "rosidl_interface_packages"
    assert package.findtext("export/build_type") == "ament_cmake"


def test_the_source_folder_does_not_hide_the_built_package() -> None:
    command = [sys.executable, "-c", "import humanoid_interfaces.msg as m; print(m.__file__)"]
    printed = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout

    assert SOURCE not in Path(printed.strip()).parents

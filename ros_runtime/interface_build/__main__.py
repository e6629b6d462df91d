"""Build definitions in a process of its own: `python -m ros_runtime.interface_build SOURCE OUT --name my_interfaces`.

Prints one line of JSON. Exit status 0: built, with the types and where they are. 1: not built, with the problems
found, or with the end of the build's output when the definitions looked sound.
"""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any

from ros_runtime.interface_build.definitions import Definition, InvalidDefinitions, Part
from ros_runtime.interface_build.student_package import BuiltPackage, build_package


def main() -> None:
    """Build, print, exit."""
    parser = argparse.ArgumentParser(prog="python -m ros_runtime.interface_build", description=__doc__)
    parser.add_argument("source", type=Path, help="folder with .msg, .srv and .action files")
    parser.add_argument("out", type=Path, help="folder for what is built")
    parser.add_argument("--name", required=True, help="the package's name, such as my_interfaces")
    wanted = parser.parse_args()
    try:
        report = _report(build_package(wanted.source, wanted.out, wanted.name))
    except InvalidDefinitions as error:
        report = {"built": False, "problems": [asdict(problem) for problem in error.problems], "log": ""}
    except RuntimeError as error:
        report = {"built": False, "problems": [], "log": str(error)}
    print(json.dumps({"package": wanted.name, **report}))
    sys.exit(0 if report["built"] else 1)


def _report(package: BuiltPackage) -> dict[str, Any]:
    return {
        "built": True,
        "seconds": round(package.seconds, 3),
        "prefix": str(package.prefix),
        "environment": package.variables({}),
        "types": {f"{package.name}/{each.kind}/{each.name}": _parts(each) for each in package.definitions},
    }


def _parts(definition: Definition) -> dict[str, Any]:
    return {name: _part(part) for name, part in definition.parts.items()}


def _part(part: Part) -> dict[str, Any]:
    constants = {name: {"type": kind, "value": value} for name, (kind, value) in part.constants.items()}
    return {"fields": part.fields, "constants": constants}


if __name__ == "__main__":
    main()

"""Build definitions in a process of its own: `python -m ros_runtime.interface_build SOURCE OUT --name my_interfaces`.

Prints JSON. Exit status 0: the package was built; the JSON has its types and its location. Exit status 1: it was not
built; the JSON has the first problems and the number of others, or, if the definitions seem correct, the end of the
build's output.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from ros_runtime.interface_build.build_time import BuildTooLong, limit_processor_time
from ros_runtime.interface_build.definitions import Definition, InvalidDefinitions, Part, Problem
from ros_runtime.interface_build.student_package import BuiltPackage, build_package

MOST_PROBLEMS = 20
LONGEST_TEXT = 150  # characters
LONGEST_LOG = 2000  # characters


def main() -> None:
    """Build, print, exit."""
    parser = argparse.ArgumentParser(prog="python -m ros_runtime.interface_build", description=__doc__)
    parser.add_argument("source", type=Path, help="folder with .msg, .srv and .action files")
    parser.add_argument("out", type=Path, help="folder for what is built")
    parser.add_argument("--name", required=True, help="the package's name, such as my_interfaces")
    parser.add_argument("--processor-time", type=int, help="limit of processor time for each process, in s")
    wanted = parser.parse_args()
    try:
        with limit_processor_time(wanted.processor_time):
            report = _report(build_package(wanted.source, wanted.out, wanted.name))
    except InvalidDefinitions as error:
        report = _problems(error.problems)
    except BuildTooLong as error:
        report = _problems([Problem("", 0, "", str(error), "a definition whose build takes a few seconds")])
    except RuntimeError as error:
        report = {"built": False, "problems": [], "more": 0, "log": str(error)[-LONGEST_LOG:]}
    # Short lines, because a program that captures the output may wrap long ones.
    print(json.dumps({"package": wanted.name, **report}, indent=1))
    sys.exit(0 if report["built"] else 1)


def _report(package: BuiltPackage) -> dict[str, Any]:
    return {
        "built": True,
        "seconds": round(package.seconds, 3),
        "prefix": str(package.prefix),
        "environment": package.variables({}),
        "types": {f"{package.name}/{each.kind}/{each.name}": _parts(each) for each in package.definitions},
    }


def _problems(problems: Sequence[Problem]) -> dict[str, Any]:
    """Return the first problems, with long texts shortened."""
    shown = [
        asdict(
            replace(
                problem, text=_cut(problem.text), wrong=_cut(problem.wrong), expected=_cut(problem.expected)
            )
        )
        for problem in problems[:MOST_PROBLEMS]
    ]
    return {"built": False, "problems": shown, "more": len(problems) - len(shown), "log": ""}


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST_TEXT else f"{text[:LONGEST_TEXT]}…"


def _parts(definition: Definition) -> dict[str, Any]:
    return {name: _part(part) for name, part in definition.parts.items()}


def _part(part: Part) -> dict[str, Any]:
    constants = {name: {"type": kind, "value": value} for name, (kind, value) in part.constants.items()}
    return {"fields": part.fields, "constants": constants}


if __name__ == "__main__":
    main()

"""Build definitions in a process of its own: `python -m ros_runtime.interface_build SOURCE OUT --name my_interfaces`.

Prints JSON. Exit status 0: the package was built; the JSON has its types and its location. Exit status 1: it was not
built; the JSON has the first problems and the number of others, or, if the definitions seem correct, the end of the
build's output.
"""

from __future__ import annotations

import argparse
import json
import resource
import signal
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any, NoReturn

from ros_runtime.interface_build.definitions import Definition, InvalidDefinitions, Part, Problem
from ros_runtime.interface_build.student_package import BuiltPackage, build_package

# A failed build that used this share of the limit counts as too long: the kernel kills a process by its count of clock
# ticks, and the time that it reports afterwards can be shorter.
EXCEEDED_SHARE = 0.5
REPORT_TIME = 5  # s between soft and hard limit, in which the process can still report that it was too long
MOST_PROBLEMS = 20
LONGEST_TEXT = 150  # characters
LONGEST_LOG = 2000  # characters


class BuildTooLong(BaseException):
    """A process of the build has reached its limit of processor time.

    A BaseException, because the interrupted code treats every Exception as a fault of the definition.
    """


@contextmanager
def limit_processor_time(seconds: int | None) -> Iterator[None]:
    """Limit the processor time (s) of this process and of each process that it starts; None: no limit.

    The limit remains after the `with` block.

    Raises:
        BuildTooLong: the limit was reached.
    """
    if seconds is None:
        yield
        return

    def raise_too_long(*_: Any) -> NoReturn:
        raise BuildTooLong(f"building it takes more than {seconds} s")

    signal.signal(signal.SIGXCPU, raise_too_long)
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + REPORT_TIME))
    try:
        yield
    except RuntimeError:
        children = resource.getrusage(resource.RUSAGE_CHILDREN)
        if children.ru_utime + children.ru_stime >= EXCEEDED_SHARE * seconds:
            raise_too_long()
        raise


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

"""A pytest plugin that writes one line of JSON a test: so a file that hangs or crashes has told how far it came."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

OUTCOMES_VARIABLE = "UPSTREAM_OUTCOMES"


def pytest_collection_finish(session: Any) -> None:
    """Write the names of the tests before the first one runs."""
    _write({"collected": [_name(item.nodeid) for item in session.items]})


def pytest_runtest_logreport(report: Any) -> None:
    """Write how a test went; its set-up and its end count when they fail, and a skip in the set-up."""
    if report.when == "call" or not report.passed:
        _write(
            {
                "test": _name(report.nodeid),
                "outcome": report.outcome,
                "why": str(report.longrepr or "")[-2000:],
            }
        )


def _name(nodeid: str) -> str:
    return nodeid.partition("::")[2]


def _write(line: dict[str, Any]) -> None:
    with Path(os.environ[OUTCOMES_VARIABLE]).open("a", encoding="utf-8") as file:
        file.write(json.dumps(line) + "\n")

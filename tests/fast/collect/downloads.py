"""Downloads as platforms make them, as zip files and as folders."""

from __future__ import annotations

import json
import stat
import zipfile
from collections.abc import Mapping
from pathlib import Path

PROGRAM = "print('battery')\n"


def notebook(source: str = PROGRAM, exercise: str = "battery_service") -> str:
    cell = {
        "cell_type": "code",
        "execution_count": None,
        "id": "a",
        "metadata": {},
        "outputs": [],
        "source": f"%%writefile {exercise}.py\n{source}",
    }
    return json.dumps({"cells": [cell], "metadata": {}, "nbformat": 4, "nbformat_minor": 5})


def zipped(path: Path, files: Mapping[str, str | bytes]) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    return path


def unpacked(path: Path, files: Mapping[str, str | bytes]) -> Path:
    for name, content in files.items():
        place = path / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content.encode() if isinstance(content, str) else content)
    return path


def with_link(path: Path, name: str, target: str) -> Path:
    entry = zipfile.ZipInfo(name)
    entry.external_attr = (stat.S_IFLNK | 0o777) << 16
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr(entry, target)
    return path


CANVAS = {
    "leeanna_101_5001_battery_service.ipynb": notebook("first = 1\n"),
    "leeanna_101_5009_battery_service-1.ipynb": notebook("second = 2\n"),
    "oneilbert_LATE_102_5002_battery_service.py": PROGRAM,
    "kimcleo_103_5003_question.html": "<p>late?</p>",
}
MOODLE = {
    "Anna Lee_9001_assignsubmission_file_/battery_service.ipynb": notebook(),
    "Zoë O'Neil_9002_assignsubmission_file_battery_service.py": PROGRAM,
    "Kim Cleo_9003_assignsubmission_onlinetext_/onlinetext.html": "<p>here</p>",
}
METADATA = """---
submission_77:
  :submitters:
  - :name: Anna Lee
    :sid: '2101'
    :email: anna@x.org
  :created_at: 2026-03-01 13:30:05.123 +01:00
  :score: 0.0
  :results: !ruby/hash:ActiveSupport::HashWithIndifferentAccess
    tests: []
submission_78:
  :submitters:
  - :name: Bert
    :email: bert@x.org
  - :name: Cleo
    :email: cleo@x.org
  :created_at: 2026-03-01 10:00:00.000000000 Z
"""
GRADESCOPE = {
    "assignment_4_export/submission_metadata.yml": METADATA,
    "assignment_4_export/submission_77/battery_service.py": PROGRAM,
    "assignment_4_export/submission_78/my.ipynb": notebook(),
    "assignment_4_export/submission_78/battery_service.ipynb": notebook("named = 1\n"),
    "assignment_4_export/submission_79/battery_service.py": PROGRAM,
}
CLASSROOM50 = {
    "robotics-2026-battery-service-anna-lee/battery_service.py": PROGRAM,
    "robotics-2026-battery-service-anna-lee/.git/config": "[core]",
    "robotics-2026-battery-service-anna-lee/old/battery_service.py": "old = 1\n",
    "robotics-2026-battery-service-bert/README.md": "# hello",
    "robotics-2026-battery-service-bert/exercises/battery_service/battery_service.ipynb": notebook(),
    "robotics-2026-battery-service-bert/walk_to.py": PROGRAM,
}
ALL = {"canvas": CANVAS, "moodle": MOODLE, "gradescope": GRADESCOPE, "classroom50": CLASSROOM50}

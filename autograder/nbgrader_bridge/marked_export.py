"""`nbgrader export` without the submissions that a person has yet to mark, whose points would look like 0."""

from __future__ import annotations

import csv
from pathlib import Path

from nbgrader.api import Gradebook, MissingEntry
from nbgrader.plugins.export import CsvExportPlugin


class MarkedCsvExport(CsvExportPlugin):
    """nbgrader's grades.csv; it names what it leaves out."""

    def export(self, gradebook: Gradebook) -> None:
        """Write the file."""
        super().export(gradebook)
        path = Path(self.to or "grades.csv")
        with path.open(newline="", encoding="utf-8") as file:
            heading, *rows = csv.reader(file)
        kept = [row for row in rows if not self._waits(gradebook, dict(zip(heading, row, strict=False)))]
        with path.open("w", newline="", encoding="utf-8") as file:
            csv.writer(file, lineterminator="\n").writerows([heading, *kept])

    def _waits(self, gradebook: Gradebook, row: dict[str, str]) -> bool:
        try:
            waits = gradebook.find_submission(row["assignment"], row["student_id"]).needs_manual_grade
        except MissingEntry:
            return False
        if waits:
            self.log.warning("%s of %s is not marked yet: left out", row["assignment"], row["student_id"])
        return bool(waits)

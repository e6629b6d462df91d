"""What a fuzzer found: an input for which something does not hold that always has to."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from ros_runtime.project import PROJECT

FOLDER = PROJECT / "build" / "fuzz"  # what is found is kept here


@dataclass(frozen=True)
class Finding:
    """The fuzzer's name, its seed, what went wrong, and the input as text."""

    fuzzer: str
    seed: int
    problem: str
    input: str

    @property
    def command(self) -> str:
        """What shows it again."""
        return f"./course test --fuzz 0 --fuzz-only {self.fuzzer} --fuzz-seed {self.seed}"

    def keep(self, folder: Path = FOLDER) -> Path:
        """Write it to a file and return the file."""
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f"{self.fuzzer}-{self.seed}.txt"
        text = f"{self.command}\n\n{self.problem}\n\n--- input ---\n{self.input}\n"
        path.write_text(text, encoding="utf-8", errors="backslashreplace")
        return path

    def __str__(self) -> str:
        return f"{self.fuzzer}, seed {self.seed}: {self.problem}\nagain: {self.command}"

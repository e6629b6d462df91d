"""Sets up another commit of this project in a folder of its own, to compare it with this one."""

from __future__ import annotations

import subprocess

from bench.arena.arena_costs import PROJECT, BenchFailed, Version

FOLDER = PROJECT / "build" / "other_versions"


def version_of(commit: str) -> Version:
    """Return a commit's checkout with its environment; making it takes some minutes, once.

    Raises:
        BenchFailed: there is no such commit, or its set-up fails.
    """
    found = _run("git", "-C", str(PROJECT), "rev-parse", "--verify", "--quiet", f"{commit}^{{commit}}")
    if found.returncode:
        raise BenchFailed(f"{commit!r} is neither a file that --json wrote nor a commit of {PROJECT}")
    name = found.stdout.strip()
    project = FOLDER / name
    if not (project / "course").exists():
        _require(_run("git", "clone", "--quiet", str(PROJECT), str(project)), f"clone {commit}")
        _require(_run("git", "-C", str(project), "checkout", "--quiet", name), f"check out {commit}")
    _require(_run(str(project / "course"), "--help"), f"set up {commit}")
    return Version(project, project / ".venv" / "bin" / "python")


def _run(*command: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(command, capture_output=True, text=True, check=False)


def _require(done: subprocess.CompletedProcess[str], what: str) -> None:
    if done.returncode:
        raise BenchFailed(f"could not {what}: {done.stderr[-2000:]}")

"""`course lab`: JupyterLab on the clone."""

import os
import sys
from pathlib import Path

import typer

from ros_runtime.environment import ros_environment

ROOT = Path(__file__).resolve().parents[2]


def lab(context: typer.Context) -> None:
    """Open JupyterLab on chapters and exercises; further arguments go to it, for example --no-browser."""
    command = [
        *(sys.executable, "-m", "jupyterlab"),
        f"--ServerApp.root_dir={ROOT}",
        "--LabApp.default_url=/lab/tree/chapters",
        *context.args,
    ]
    if os.geteuid() == 0:
        command.append("--allow-root")
    # Notebooks and the terminals beside them behave alike: wrong field types are errors in both.
    os.execve(sys.executable, command, {**os.environ, **ros_environment()})

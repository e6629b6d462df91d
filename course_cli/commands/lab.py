"""`course lab`: JupyterLab in the clone."""

from __future__ import annotations

import os
import sys

import typer

from ros_runtime.environment import ros_environment
from ros_runtime.project import PROJECT

# Only what a student needs: nbgrader's "Validate" would run the notebook and call its own time limit a failed check.
CONFIGURATION = PROJECT / "course_cli" / "jupyter"


def lab(context: typer.Context) -> None:
    """Open JupyterLab on chapters and exercises, at the page that lists them.

    The address is printed, too. Further arguments go to JupyterLab: --no-browser, --port 8890, --help-all.
    """
    command = [
        *(sys.executable, "-m", "jupyterlab"),
        f"--ServerApp.root_dir={PROJECT}",
        "--LabApp.default_url=/lab/tree/chapters/README.md",
        *context.args,
    ]
    if os.geteuid() == 0:
        command.append("--allow-root")
    # Notebooks and the terminals beside them behave alike: wrong field types are errors in both.
    environment = {**os.environ, **ros_environment()}
    others = environment.get("JUPYTER_CONFIG_PATH")
    environment["JUPYTER_CONFIG_PATH"] = os.pathsep.join(filter(None, [str(CONFIGURATION), others]))
    os.execve(sys.executable, command, environment)

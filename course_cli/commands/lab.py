"""`course lab`: JupyterLab in the clone."""

from __future__ import annotations

import os
import sys

import typer

from ros_cli.real_ros2 import path_with_ros2
from ros_runtime import notebook_domains
from ros_runtime.environment import ros_environment
from ros_runtime.project import PROJECT
from ros_runtime.ros_domain import loopback_variables

# Only what a student needs: nbgrader's "Validate" would run the notebook and call its own time limit a failed check.
CONFIGURATION = PROJECT / "course_cli" / "jupyter"


def lab(context: typer.Context) -> None:
    """Open JupyterLab on chapters and exercises, at the page that shows what you have done.

    The address is printed, too. Its terminals and cells have `ros2`. Further arguments go to JupyterLab:
    --no-browser, --port 8890, --help-all.
    """
    # Not a login shell, whose /etc/profile would take `ros2` off the PATH.
    terminals = {"shell_command": [os.environ.get("SHELL") or "bash"]}
    command = [
        *(sys.executable, "-m", "jupyterlab"),
        f"--ServerApp.root_dir={PROJECT}",
        f"--ServerApp.terminado_settings={terminals}",
        "--LabApp.default_url=/lab/tree/start_here.ipynb",
        *context.args,
    ]
    if os.geteuid() == 0:
        command.append("--allow-root")
    os.execve(sys.executable, command, lab_environment())


def lab_environment() -> dict[str, str]:
    """Return the environment of JupyterLab, its kernels and its terminals."""
    # Notebooks and the terminals beside them behave alike: wrong field types are errors in both.
    environment = {
        **os.environ,
        **ros_environment(),
        **loopback_variables(),
        **notebook_domains.lab_variables(),
    }
    # It would override the profile that keeps nodes on this machine.
    environment.pop("ROS_AUTOMATIC_DISCOVERY_RANGE", None)
    environment["PATH"] = path_with_ros2(environment.get("PATH", os.defpath))
    environment.pop("ROS_DOMAIN_ID", None)  # each notebook has its own, which `ros2` in a terminal joins
    others = environment.get("JUPYTER_CONFIG_PATH")
    environment["JUPYTER_CONFIG_PATH"] = os.pathsep.join(filter(None, [str(CONFIGURATION), others]))
    return environment

"""`course lab`: starts JupyterLab in the clone."""

from __future__ import annotations

import os
import sys
from importlib.util import find_spec
from pathlib import Path

import typer

from autograder.report.console import LineConsole
from course_cli.ending import COMMAND_FAILED, error_exit
from course_cli.work_folder import work_folder
from ros_cli.real_ros2 import path_with_ros2
from ros_runtime import notebook_domains
from ros_runtime.environment import ros_environment
from ros_runtime.project import PROJECT, WORK_VARIABLE
from ros_runtime.ros_domain import loopback_variables

# Settings that turn off nbgrader's extensions: "Validate" would run the notebook, and report its timeout as a failure.
CONFIGURATION = PROJECT / "course_cli" / "jupyter"
HUB_TOKEN = "JUPYTERHUB_API_TOKEN"  # set by JupyterHub in the environment of a user's server


def lab(context: typer.Context) -> None:
    """Open JupyterLab with the chapters and exercises, at the page that shows your progress.

    The command also prints JupyterLab's address. The terminals and cells have the command `ros2`. Further arguments go
    to JupyterLab: --no-browser, --port 8890, --help-all. If several students share the course and cannot write to it,
    your notebooks are in ~/humanoid_course, or in the folder COURSE_WORK. If JupyterHub starts this command, it runs
    the user's server.
    """
    try:
        folder = work_folder()
    except OSError as error:
        reason = (
            f"your notebooks cannot be saved: {error}.\nNext: COURSE_WORK=/a/folder/of/yours ./course lab"
        )
        raise error_exit(LineConsole(), reason, COMMAND_FAILED) from error
    # Terminals start no login shell, because /etc/profile would remove `ros2` from the PATH.
    terminals = {"shell_command": [os.environ.get("SHELL") or "bash"]}
    command = [
        *(sys.executable, "-m", _server()),
        f"--ServerApp.root_dir={folder}",
        f"--ServerApp.terminado_settings={terminals}",
        "--LabApp.default_url=/lab/tree/start_here.ipynb",
        *context.args,
    ]
    if os.geteuid() == 0:
        command.append("--allow-root")
    os.execve(sys.executable, command, {**lab_environment(), WORK_VARIABLE: str(folder)})


def _server() -> str:
    """Return the module to run: JupyterLab alone, or JupyterHub's server for one user."""
    if HUB_TOKEN not in os.environ:
        return "jupyterlab"
    if find_spec("jupyterhub") is None:
        line = f"{PROJECT}/.venv/bin/uv pip install --python {PROJECT}/.venv/bin/python jupyterhub"
        reason = (
            f"JupyterHub started this command, but the course's environment lacks jupyterhub.\nNext: {line}"
        )
        raise error_exit(LineConsole(), reason, COMMAND_FAILED)
    return "jupyterhub.singleuser"


def lab_environment() -> dict[str, str]:
    """Return the environment of JupyterLab, its kernels and its terminals."""
    # In notebooks as in terminals, a field of the wrong type is an error.
    environment = {
        **os.environ,
        **ros_environment(),
        **loopback_variables(),
        **notebook_domains.lab_variables(),
    }
    # This variable would override the profile that keeps nodes on this machine.
    environment.pop("ROS_AUTOMATIC_DISCOVERY_RANGE", None)
    commands = Path(sys.executable).parent  # at the end, for `!course submit` in a cell
    environment["PATH"] = f"{path_with_ros2(environment.get('PATH', os.defpath))}{os.pathsep}{commands}"
    environment.pop(
        "ROS_DOMAIN_ID", None
    )  # each notebook has a domain of its own, which `ros2` in a terminal joins
    others = environment.get("JUPYTER_CONFIG_PATH")
    environment["JUPYTER_CONFIG_PATH"] = os.pathsep.join(filter(None, [str(CONFIGURATION), others]))
    return environment

"""`course lab`: JupyterLab in the clone."""

from __future__ import annotations

import os
import sys
from importlib.util import find_spec

import typer
from rich.console import Console

from course_cli.ending import COMMAND_FAILED, ended
from course_cli.work_folder import work_folder
from ros_cli.real_ros2 import path_with_ros2
from ros_runtime import notebook_domains
from ros_runtime.environment import ros_environment
from ros_runtime.project import PROJECT, WORK_VARIABLE
from ros_runtime.ros_domain import loopback_variables

# Only what a student needs: nbgrader's "Validate" would run the notebook and call its own time limit a failed check.
CONFIGURATION = PROJECT / "course_cli" / "jupyter"
HUB_TOKEN = "JUPYTERHUB_API_TOKEN"  # set by JupyterHub in the environment of a user's server


def lab(context: typer.Context) -> None:
    """Open JupyterLab on chapters and exercises, at the page that shows your progress.

    The address is printed, too. Its terminals and cells have `ros2`. Further arguments go to JupyterLab:
    --no-browser, --port 8890, --help-all. Where the course cannot be written, because several students share it, your
    notebooks lie in ~/humanoid_course, or where COURSE_WORK says. Started by JupyterHub, it is that user's server.
    """
    try:
        folder = work_folder()
    except OSError as error:
        reason = f"your notebooks cannot be kept: {error}.\nNext: COURSE_WORK=/a/folder/of/yours ./course lab"
        raise ended(Console(), reason, COMMAND_FAILED) from error
    # Not a login shell, whose /etc/profile would take `ros2` off the PATH.
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
    """The module to run: JupyterLab by itself, or as a server of JupyterHub."""
    if HUB_TOKEN not in os.environ:
        return "jupyterlab"
    if find_spec("jupyterhub") is None:
        line = f"{PROJECT}/.venv/bin/uv pip install --python {PROJECT}/.venv/bin/python jupyterhub"
        reason = f"JupyterHub starts this, and the course's environment lacks it.\nNext: {line}"
        raise ended(Console(soft_wrap=True), reason, COMMAND_FAILED)
    return "jupyterhub.singleuser"


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

"""`course lab`: starts JupyterLab in the clone."""

from __future__ import annotations

import os
import shutil
import sys
from importlib.util import find_spec
from pathlib import Path

import typer

from ros_cli.real_ros2 import path_with_ros2
from ros_runtime import notebook_domains
from ros_runtime.course_error import CommandFailed
from ros_runtime.environment import ros_environment
from ros_runtime.project import COURSE, PROJECT, WORK_VARIABLE
from ros_runtime.ros_domain import loopback_variables

# Settings that turn off nbgrader's extensions: "Validate" would run the notebook, and report its timeout as a failure.
CONFIGURATION = PROJECT / "course_cli" / "jupyter"
HUB_TOKEN = "JUPYTERHUB_API_TOKEN"  # set by JupyterHub in the environment of a user's server
NAME = "humanoid_course"  # of a student's own folder beside a shared installation
PARTS = ("start_here.ipynb", "chapters", "exercises", "docs")


def lab(context: typer.Context) -> None:
    """Open JupyterLab with the chapters and exercises, at the page that shows your progress.

    The command also prints JupyterLab's address. Ctrl-C ends JupyterLab with all kernels, robots and nodes. The
    terminals and cells have the command `ros2`. Further arguments go to JupyterLab: --no-browser, --port 8890,
    --help-all.

    If several students share the course and cannot write to it, your notebooks are in ~/humanoid_course, or in the
    folder COURSE_WORK. If JupyterHub starts this command, it runs the user's server.
    """
    try:
        folder = work_folder()
    except OSError as error:
        raise CommandFailed(
            f"your notebooks cannot be saved: {error}.\nNext: COURSE_WORK=/a/folder/of/yours ./course lab"
        ) from error
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
        raise CommandFailed(
            f"JupyterHub started this command, but the course's environment lacks jupyterhub.\nNext: {line}"
        )
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
    # each notebook has a domain of its own, which `ros2` in a terminal joins
    environment.pop("ROS_DOMAIN_ID", None)
    others = environment.get("JUPYTER_CONFIG_PATH")
    environment["JUPYTER_CONFIG_PATH"] = os.pathsep.join(filter(None, [str(CONFIGURATION), others]))
    return environment


def work_folder() -> Path:
    """Return the folder of this student's notebooks: $COURSE_WORK, else a writable course, else ~/humanoid_course.

    Missing files are copied from the course; existing ones belong to the student and are never changed.

    Raises:
        OSError: the folder cannot be written.
    """
    chosen = os.environ.get(WORK_VARIABLE)
    if not chosen and os.access(COURSE, os.W_OK):
        return COURSE
    folder = Path(chosen).absolute() if chosen else Path.home() / NAME
    if folder != COURSE:
        for part in PARTS:
            _copy_missing(COURSE / part, folder / part)
    return folder


def _copy_missing(source: Path, place: Path) -> None:
    """Copy a file, or the files of a folder, unless they exist already; permissions are not copied."""
    files = sorted(source.rglob("*")) if source.is_dir() else [source]
    for file in files:
        # Files of other types were written by notebooks that somebody ran; they are not part of the course.
        if not file.is_file() or file.suffix not in (".ipynb", ".md", ".png", ".gif", ".svg", ".webp"):
            continue
        copy = place / file.relative_to(source) if source.is_dir() else place
        if not copy.exists():
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, copy)

"""Build a ROS 2 interface package with CMake into a prefix, unless the same sources have been built already."""

from __future__ import annotations

import hashlib
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import TextIO

from ros_runtime.interface_build.build_environment import PYTHON_LIB, RosBuild, ros_build, sourced_prefixes

FOLDER = Path(__file__).resolve().parent
FROM_WHEELS = "from_wheels.cmake"
BUILD_FILES = (FOLDER / "cmake_package.py", FOLDER / "build_environment.py", *sorted(FOLDER.glob("*.cmake")))
LOG_TAIL_LINES = 40
# CMake and the generators fail on paths with "&", quotes or non-ASCII letters.
_PLAIN_PATH = re.compile(r"[A-Za-z0-9._/+-]+")


def built_prefix(
    source: Path, builds: Path, environ: Mapping[str, str], made_with: Sequence[Path] = ()
) -> Path:
    """Return the folder under `builds` for a build of the present files in `source`.

    `made_with` are further files that the build depends on, such as the lock file of the tools' versions.
    """
    digest = hashlib.sha256()
    for path in (*_files(source), *BUILD_FILES, *made_with):
        digest.update(f"{path.name}\0".encode() + path.read_bytes() + b"\0")
    digest.update(repr([str(prefix) for prefix in sourced_prefixes(environ)]).encode())
    return builds / f"{source.name}-{sys.implementation.cache_tag}-{digest.hexdigest()[:16]}"


def build(source: Path, builds: Path, environ: Mapping[str, str], made_with: Sequence[Path] = ()) -> Path:
    """Build the interface package in `source`, unless there is a build of the same sources.

    The folder `source` has the package's name.

    Returns:
        The prefix, with lib/, share/ and include/.

    Raises:
        RuntimeError: CMake failed or there is no C++ compiler; the message ends with the build's output.
    """
    prefix = built_prefix(source, builds, environ, made_with)
    if prefix.is_dir():
        return prefix
    if not (environ.get("CXX") or shutil.which("c++") or shutil.which("g++")):
        raise RuntimeError(
            f"{source.name} needs a C++ compiler and none was found.\nNext: sudo apt-get install -y g++"
        )
    builds.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=f"{source.name}-", dir=_plain_folder(builds)) as scratch:
        copied = shutil.copytree(
            source, Path(scratch, source.name), ignore=shutil.ignore_patterns("__pycache__")
        )
        staged = Path(scratch, "prefix")
        _run_cmake(copied, Path(scratch, "cmake"), staged, ros_build(environ), builds / f"{source.name}.log")
        # The prefix appears by one rename at the end, so an interrupted build is never taken for a finished one.
        with tempfile.TemporaryDirectory(prefix=f"{source.name}-", dir=builds) as beside:
            os.replace(shutil.move(staged, beside), prefix)
    return prefix


def _plain_folder(builds: Path) -> Path:
    """Return `builds` or, if CMake cannot take its path, a folder for temporary files.

    Raises:
        RuntimeError: there is no such folder.
    """
    for folder in (builds.resolve(), Path(tempfile.gettempdir()), Path("/tmp"), Path("/var/tmp")):
        if _PLAIN_PATH.fullmatch(str(folder)) and os.access(folder, os.W_OK):
            return folder
    raise RuntimeError(
        f"CMake cannot build in {builds}, whose path has more than plain letters and digits, and /tmp is not writable."
        "\nNext: move your folder to a path of plain letters and digits."
    )


def _run_cmake(source: Path, binary_dir: Path, prefix: Path, ros: RosBuild, log: Path) -> None:
    configure = [
        *("-S", str(source), "-B", str(binary_dir)),
        f"-DCMAKE_INSTALL_PREFIX={prefix}",
        f"-DPYTHON_INSTALL_DIR={PYTHON_LIB}",
        f"-DPython3_EXECUTABLE={ros.python}",
        "-DBUILD_TESTING=OFF",
        # Without optimisation, which costs compile time and gains nothing: the code only copies fields between Python
        # and C. Without assertions, which would end the process if a field has another type.
        *("-DCMAKE_BUILD_TYPE=None", "-DCMAKE_C_FLAGS=-O0 -DNDEBUG", "-DCMAKE_CXX_FLAGS=-O0 -DNDEBUG"),
    ]
    if ros.from_wheels:
        for file in FOLDER.glob("*.cmake"):
            shutil.copy(file, binary_dir.parent)
        included = binary_dir.with_name(FROM_WHEELS)
        configure += ["-G", "Ninja", f"-DCMAKE_PROJECT_{source.name}_INCLUDE={included}"]
    steps = [
        configure,
        ["--build", str(binary_dir), "--parallel", str(os.cpu_count() or 1)],
        ["--install", str(binary_dir)],
    ]
    cmake = _plain_cmake(binary_dir.parent) if ros.from_wheels else "cmake"
    with log.open("w", encoding="utf-8") as output:
        for step in steps:
            _run([cmake, *step], ros.environment, output, log)


def _plain_cmake(scratch: Path) -> str:
    """Return the path of cmake, or of a copy of it if cmake cannot handle the characters in its own path."""
    package = find_spec("cmake")
    if package is None or package.origin is None:
        return "cmake"
    installed = Path(package.origin).resolve().with_name("data")
    if _PLAIN_PATH.fullmatch(str(installed)):
        return "cmake"
    return str(Path(shutil.copytree(installed, scratch / "tool"), "bin/cmake"))


def _run(command: list[str], environment: Mapping[str, str], output: TextIO, log: Path) -> None:
    executable = shutil.which(command[0], path=environment.get("PATH"))
    if executable is None:
        raise RuntimeError(f"{command[0]} was not found.\nNext: sudo apt-get install -y {command[0]}")
    command = [executable, *command[1:]]
    finished = subprocess.run(command, env=dict(environment), stdout=output, stderr=subprocess.STDOUT)
    if finished.returncode != 0:
        lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
        raise RuntimeError(
            f"The interfaces could not be built: status {finished.returncode} of `{shlex.join(command)}`.\n"
            + "\n".join(lines[-LOG_TAIL_LINES:])
            + f"\nThe whole output is in {log}."
        )


def _files(folder: Path) -> list[Path]:
    """Return the files that a build depends on, in a fixed order."""
    return sorted(path for path in folder.rglob("*") if path.is_file() and "__pycache__" not in path.parts)

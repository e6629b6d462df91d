"""Builds a student's interface package: .msg, .srv and .action files become types that nodes can import."""

from __future__ import annotations

import os
from pathlib import Path

from lab.errors import LabError
from ros_runtime.cell_notice import notice
from ros_runtime.interface_build.definitions import InvalidDefinitions
from ros_runtime.interface_build.student_package import (
    BuiltPackage,
    build_package,
    checked_definitions,
    write_package,
)

BUILDS = Path(".interfaces")  # hidden, like the folders of other tools


def build_interfaces(folder: str | Path) -> None:
    """Build the definitions in a folder as a package with the folder's name.

    This notebook and nodes that you start afterwards can import the package. Nodes that already run keep the types
    that they have imported. Unchanged definitions are not built again.

    Raises:
        LabError: there is nothing to build, or a definition is wrong; the message has its file and line, and what was
            expected.
    """
    source = _existing_folder(folder)
    try:
        with notice(f"{source.name} is being built, which takes about 10 s, on a busy machine minutes."):
            package = build_package(source, BUILDS, source.resolve().name)
    except InvalidDefinitions as error:
        raise LabError(f"{source.name} was not built.\n{error}") from error
    except RuntimeError as error:
        raise LabError(str(error)) from error
    os.environ.update(package.variables(os.environ), AMENT_PREFIX_PATH=package.prefix_path(os.environ))
    print(_summary(package))
    if package.is_importable_here():
        package.make_importable_here()
    else:
        print(
            f"This notebook has imported an earlier version of {package.name} and still uses it. Nodes that you start "
            "now use the new version. To use it in this notebook, too, restart the kernel (menu Kernel)."
        )


def export_package(folder: str | Path, workspace: str | Path) -> None:
    """Write the definitions in a folder as a package for `colcon build`, into the folder `src` of a workspace.

    Raises:
        LabError: there is no such folder, or a definition is wrong; the message has its file and line, and what was
            expected.
    """
    source = _existing_folder(folder)
    name = source.resolve().name
    package = Path(workspace) / "src" / name
    try:
        definitions = checked_definitions(source, name, os.environ)
    except InvalidDefinitions as error:
        raise LabError(f"{name} was not written.\n{error}") from error
    write_package(package, name, definitions)
    print("\n".join(sorted(str(path) for path in package.rglob("*") if path.is_file())))


def _existing_folder(folder: str | Path) -> Path:
    if not Path(folder).is_dir():
        raise LabError(f"there is no folder {folder} in {Path.cwd()}; run the cells that write its files")
    return Path(folder)


def _summary(package: BuiltPackage) -> str:
    types = ", ".join(sorted(f"{package.name}/{each.kind}/{each.name}" for each in package.definitions))
    return f"{types}: {'built' if package.is_new else 'unchanged'} ({package.seconds:.1f} s)"

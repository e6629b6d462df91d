"""Build the interface package of a notebook: .msg, .srv and .action files become types that nodes can import."""

from __future__ import annotations

import os
from pathlib import Path

from lab.errors import LabError
from ros_runtime.interface_build.definitions import InvalidDefinitions
from ros_runtime.interface_build.student_package import (
    BuiltPackage,
    build_package,
    checked_definitions,
    write_package,
)

BUILDS = Path(".interfaces")  # hidden, as for the files of any tool


def build_interfaces(folder: str | Path) -> None:
    """Build the definitions in a folder; the folder's name becomes the package's.

    Nodes that you start afterwards, and this notebook, can import it. Nodes that already run keep the types they have.
    Definitions that have not changed are not built again.

    Raises:
        LabError: there is nothing to build, or a definition is wrong: which file, which line, what was expected.
    """
    source = _existing_folder(folder)
    try:
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
            f"This notebook imported an earlier {package.name} and keeps it. Nodes that you start now have the "
            "new one; to use it here as well, restart the kernel (menu Kernel)."
        )


def export_package(folder: str | Path, workspace: str | Path) -> None:
    """Write the definitions in a folder into the `src` of a workspace, as a package that `colcon build` builds.

    Raises:
        LabError: there is no such folder, or a definition is wrong: which file, which line, what was expected.
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

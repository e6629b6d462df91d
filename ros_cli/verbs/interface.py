"""`ros2 interface`: show, list."""

from __future__ import annotations

import os
import sys
from argparse import Namespace
from collections.abc import Iterator
from pathlib import Path

from rosidl_adapter.parser import Type

from ros_cli.errors import CommandError
from ros_cli.verb import Verbs, add_flag, add_verb

TITLES = {"msg": "Messages", "srv": "Services", "action": "Actions"}
SEPARATOR = "---"


def add_verbs(verbs: Verbs) -> None:
    """Add the verbs of this group."""
    listing = add_verb(verbs, "list", print_list, "List all interface types available")
    add_flag(listing, "-m", "--only-msgs", help="Print out only the message types")
    add_flag(listing, "-s", "--only-srvs", help="Print out only the service types")
    add_flag(listing, "-a", "--only-actions", help="Print out only the action types")
    show = add_verb(verbs, "show", print_definition, "Output the interface definition")
    comments = show.add_mutually_exclusive_group()
    comments.add_argument(
        "--all-comments", action="store_true", help="Show all comments, those of nested interfaces too"
    )
    comments.add_argument("--no-comments", action="store_true", help="Show no comments or whitespace")
    show.add_argument(
        "type", help="Name of an interface (e.g. 'std_msgs/msg/String'); '-' reads it from standard input"
    )


def print_list(options: Namespace) -> None:
    """Print all interfaces, or only those of the requested kinds."""
    requested = {"msg": options.only_msgs, "srv": options.only_srvs, "action": options.only_actions}
    for kind, title in TITLES.items():
        if requested[kind] or not any(requested.values()):
            print(f"{title}:")
            for name in sorted(_installed(kind)):
                print(f"    {name}")


def print_definition(options: Namespace) -> None:
    """Print a definition; the fields of nested types are indented by tabs."""
    name = sys.stdin.readline().strip() if options.type == "-" else options.type
    for line in definition(name, comments=not options.no_comments, nested_comments=options.all_comments):
        print(line)


def definition(name: str, *, comments: bool = True, nested_comments: bool = False) -> Iterator[str]:
    """Yield the lines of an interface's file, each followed by the definition of the type it nests."""
    package = name.split("/")[0]
    for line in _file(name).read_text(encoding="utf-8").splitlines():
        code = line.partition("#")[0].strip()
        if comments or code:
            yield line.rstrip() if comments else code
        nested = _nested_type(code, package)
        if nested is not None:
            inner = definition(nested, comments=nested_comments, nested_comments=nested_comments)
            yield from (f"\t{each}" if each else each for each in inner)


def _nested_type(code: str, package: str) -> str | None:
    """Return 'geometry_msgs/msg/Point' for the line 'Point[] points' of that package; None without such a type."""
    if not code or code == SEPARATOR:
        return None
    field_type = Type(code.split()[0], context_package_name=package)
    return None if field_type.is_primitive_type() else f"{field_type.pkg_name}/msg/{field_type.type}"


def _file(name: str) -> Path:
    """Return the file that defines an interface."""
    parts = name.split("/")
    if len(parts) != 3 or parts[1] not in TITLES:
        raise CommandError(
            f"Invalid name '{name}'. Expected three parts separated by '/', such as std_srvs/srv/Trigger"
        )
    package, kind, interface = parts
    folders = [share / package for share in _shares() if (share / package).is_dir()]
    if not folders:
        raise CommandError(f"Unknown package '{package}': `interface list` shows the installed interfaces")
    for folder in folders:
        if (path := folder / kind / f"{interface}.{kind}").is_file():
            return path
    raise CommandError(f"Could not find the interface '{name}': `interface list` shows the installed ones")


def _installed(kind: str) -> set[str]:
    return {
        f"{path.parents[1].name}/{kind}/{path.stem}"
        for share in _shares()
        for path in share.glob(f"*/{kind}/*.{kind}")
    }


def _shares() -> list[Path]:
    """Return the share/ folders of all packages; packages that a notebook has built come first."""
    prefixes = [*filter(None, os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)), sys.prefix]
    return [Path(prefix) / "share" for prefix in prefixes]

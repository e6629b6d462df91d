"""Gives itself the rights of root in a Docker container, and runs a program there.

Only for root, in a mount namespace of its own. Run as `python in_container.py FOLDER PROGRAM…`: FOLDER is then at
/mnt/autograder. As with Docker's own profile nobody can make namespaces or mount, and root has the rights that
containers have. What this Python needs can be read by all, as in an image, wherever it lies here.
"""

from __future__ import annotations

import errno
import os
import subprocess
import sys
from pathlib import Path

import pyseccomp

PLACE = Path("/mnt/autograder")
RIGHTS = (
    *("chown", "dac_override", "fowner", "fsetid", "kill", "setgid", "setuid", "setpcap"),
    *("net_bind_service", "net_raw", "sys_chroot", "mknod", "audit_write"),
)
NEW_NAMESPACES = (0x00020000, 0x02000000, 0x04000000, 0x08000000, 0x10000000, 0x20000000, 0x40000000)


def mount(*arguments: object) -> None:
    subprocess.run(["mount", *map(str, arguments)], check=True)


def show_to_all(shown: list[Path]) -> None:
    """Replace folders that only root may enter by folders that contain only the given paths."""
    kept = {}
    for number, path in enumerate(shown):
        kept[path] = Path(f"/mnt/shown/{number}")
        kept[path].mkdir(parents=True)
        mount("--bind", path, kept[path])
    for path in shown:
        closed = next((place for place in reversed(path.parents) if not place.stat().st_mode & 0o001), None)
        if closed:
            mount("-t", "tmpfs", "-o", "mode=755", "none", closed)
        if closed or not path.exists():
            path.mkdir(parents=True)
            mount("--bind", kept[path], path)


def refuse_namespaces() -> None:
    """Refuse the system calls that Docker's profile refuses to containers without CAP_SYS_ADMIN."""
    rules = pyseccomp.SyscallFilter(pyseccomp.ALLOW)
    for name in (
        "unshare",
        "setns",
        "mount",
        "umount2",
        "pivot_root",
        "open_tree",
        "move_mount",
        "mount_setattr",
    ):
        rules.add_rule(pyseccomp.ERRNO(errno.EPERM), name)
    rules.add_rule(pyseccomp.ERRNO(errno.ENOSYS), "clone3")
    for flag in NEW_NAMESPACES:
        rules.add_rule(
            pyseccomp.ERRNO(errno.EPERM), "clone", pyseccomp.Arg(0, pyseccomp.MASKED_EQ, flag, flag)
        )
    rules.load()


def main() -> None:
    mount("--make-rprivate", "/")
    mount("-t", "tmpfs", "-o", "mode=755", "none", "/mnt")
    PLACE.mkdir()
    mount("--bind", sys.argv[1], PLACE)
    show_to_all([Path(sys.base_prefix).resolve(), Path(sys.prefix).resolve()])
    refuse_namespaces()
    os.chdir("/")
    rights = ",".join(["-all", *(f"+{right}" for right in RIGHTS)])
    os.execvp("setpriv", ["setpriv", f"--bounding-set={rights}", "--inh-caps=-all", *sys.argv[2:]])


if __name__ == "__main__":
    main()

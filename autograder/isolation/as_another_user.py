"""Switches from root to a user that owns nothing, and then executes the given program.

bubblewrap sandboxes cannot be nested when the outer one runs as root, so root must drop its privileges first. The
paths that the sandbox has to show may be in folders that the new user cannot enter (/root), or be readable by root only
(umask 077). So this program first mounts each of them again, in a mount namespace of its own: at a place that everyone
can reach, with its owner mapped to the new user. Nothing changes on disk, and the mounts disappear with the last
process of the sandbox.

Run as `python -I -S as_another_user.py PLAN PROGRAM ARGUMENTS…`, where PLAN is JSON: the id of the process that starts
it ("parent"), a folder to mount on ("staging") and the host paths ("paths"); path number n appears as <staging>/<n>.
"""

from __future__ import annotations

import ctypes
import json
import os
import shutil
import signal
import struct
import sys

sys.path.append(os.path.abspath(f"{__file__}/../../.."))  # the project, which -I leaves out
from ros_runtime.workarounds.die_with_parent import die_with_parent

_CLONE_NEWNS = 0x00020000
_CLONE_NEWUSER = 0x10000000
_MS_NOSUID, _MS_NODEV, _MS_BIND, _MS_REC, _MS_PRIVATE = 2, 4, 4096, 16384, 1 << 18
_OPEN_TREE, _MOVE_MOUNT, _MOUNT_SETATTR = 428, 429, 442  # the same numbers on every architecture
_AT_FDCWD, _AT_EMPTY_PATH, _AT_RECURSIVE = -100, 0x1000, 0x8000
_OPEN_TREE_CLONE = 1
_MOVE_MOUNT_F_EMPTY_PATH = 4
_MOUNT_ATTR_RDONLY, _MOUNT_ATTR_IDMAP = 0x1, 0x00100000
_PR_SET_NO_NEW_PRIVS = 38
_COPY_LIMIT = 64 * 2**20  # bytes

_libc = ctypes.CDLL(None, use_errno=True)


def main() -> None:
    """Mount the paths, drop root's privileges, and execute the program."""
    plan = json.loads(sys.argv[1])
    try:
        _drop_privileges(plan["paths"], plan["staging"])
    except OSError as error:
        sys.exit(f"root could not drop its privileges: {error}")
    if not die_with_parent(plan["parent"]):
        sys.exit("the process that started this sandbox has ended")
    os.execv(sys.argv[2], sys.argv[2:])


def _drop_privileges(paths: list[str], staging: str) -> None:
    user = unused_id()
    try:
        _check(_libc.unshare(_CLONE_NEWNS), "unshare")
    except PermissionError:  # root of a container: paths that the new user cannot read stay unreadable
        _link(paths, staging)
    else:
        _mount_for(user, paths, staging)
    os.setgroups([])
    os.setresgid(user, user, user)
    os.setresuid(user, user, user)
    _check(_libc.prctl(_PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0), "prctl")


def unused_id() -> int:
    """Return an unused user id: this process's id, in a range that no system assigns.

    The kernel counts some resources by user, and a user may signal its own processes: no two arenas share
    one.
    """
    with open("/proc/self/uid_map") as lines:
        last = max(int(first) + int(count) for first, _, count in map(str.split, lines)) - 1
    unassigned = 1_900_000_000
    return unassigned + os.getpid() if last > 2 * unassigned else 20_000 + os.getpid() % 40_000


def _link(paths: list[str], staging: str) -> None:
    os.chmod(staging, 0o755)
    for number, path in enumerate(paths):
        os.symlink(path, f"{staging}/{number}")


def _mount_for(user: int, paths: list[str], staging: str) -> None:
    _mount("none", "/", None, _MS_REC | _MS_PRIVATE)
    _mount("course", staging, "tmpfs", _MS_NOSUID | _MS_NODEV, "mode=0755")
    mappings: dict[int, int] = {}
    for number, path in enumerate(paths):
        target = f"{staging}/{number}"
        if os.path.isdir(path):
            os.mkdir(target)
        else:
            os.close(os.open(target, os.O_CREAT | os.O_WRONLY, 0o644))
        owner = os.stat(path).st_uid
        try:
            if owner not in mappings:
                mappings[owner] = _user_namespace(owner, user)
            _mount_with_owner_mapped(path, target, mappings[owner])
        except OSError:  # the file system or the kernel cannot do it
            _mount_as_it_is(path, target)
    for namespace in mappings.values():
        os.close(namespace)


def _user_namespace(owner: int, user: int) -> int:
    """Return a descriptor of a user namespace that maps `owner` to `user`."""
    ready, tell = os.pipe()
    child = os.fork()
    if child == 0:
        if _libc.unshare(_CLONE_NEWUSER) == 0:
            os.write(tell, b"x")
            signal.pause()
        os._exit(1)
    os.close(tell)
    try:
        if not os.read(ready, 1):
            raise OSError("no user namespace")
        for kind in ("uid", "gid"):
            with open(f"/proc/{child}/{kind}_map", "w") as mapping:
                mapping.write(f"{owner} {user} 1")
        return os.open(f"/proc/{child}/ns/user", os.O_RDONLY)
    finally:
        os.close(ready)
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)


def _mount_with_owner_mapped(path: str, target: str, namespace: int) -> None:
    """Mount `path` again, read-only, its owner's files as the new user's: ID-mapped, mount_setattr(2)."""
    flags = _OPEN_TREE_CLONE | os.O_CLOEXEC | _AT_RECURSIVE
    tree = _syscall("open_tree", _OPEN_TREE, _AT_FDCWD, path.encode(), flags)
    try:
        attributes = struct.pack("=QQQQ", _MOUNT_ATTR_IDMAP | _MOUNT_ATTR_RDONLY, 0, 0, namespace)
        how = _AT_EMPTY_PATH | _AT_RECURSIVE
        _syscall("mount_setattr", _MOUNT_SETATTR, tree, b"", how, attributes, len(attributes))
        _syscall("move_mount", _MOVE_MOUNT, tree, b"", _AT_FDCWD, target.encode(), _MOVE_MOUNT_F_EMPTY_PATH)
    finally:
        os.close(tree)


def _mount_as_it_is(path: str, target: str) -> None:
    """Mount `path` again; where others may not read it, show a readable copy instead."""
    private = _private_entry(path)
    if private is None:
        _mount(path, target, None, _MS_BIND | _MS_REC)
    elif os.path.isdir(path) and _size(path) <= _COPY_LIMIT:
        shutil.copytree(path, target, symlinks=True, dirs_exist_ok=True)
        for folder, _, names in os.walk(target):
            os.chmod(folder, 0o755)
            for name in names:
                if not os.path.islink(file := os.path.join(folder, name)):
                    os.chmod(file, os.stat(file).st_mode | 0o444)
    else:
        sys.exit(
            f"an arena cannot read {private}, and this file system has no ID-mapped mounts: "
            f"chmod -R o+rX {path}, or run as an ordinary user"
        )


def _private_entry(path: str) -> str | None:
    """Return what others may not read: `path` or something in it. A umask makes a whole tree private."""
    inside = [os.path.join(path, name) for name in os.listdir(path)] if os.path.isdir(path) else []
    for entry in (path, *inside):
        wanted = 0o005 if os.path.isdir(entry) else 0o004
        if not os.path.islink(entry) and os.stat(entry).st_mode & wanted != wanted:
            return entry
    return None


def _size(path: str) -> int:
    files = (os.path.join(folder, name) for folder, _, names in os.walk(path) for name in names)
    return sum(os.lstat(file).st_size for file in files)


def _mount(source: str, target: str, kind: str | None, flags: int, options: str | None = None) -> None:
    encoded = [text if text is None else text.encode() for text in (source, target, kind, options)]
    _check(
        _libc.mount(encoded[0], encoded[1], encoded[2], ctypes.c_ulong(flags), encoded[3]), f"mount {target}"
    )


def _syscall(name: str, number: int, *arguments: int | bytes) -> int:
    wide = [ctypes.c_long(value) if isinstance(value, int) else value for value in arguments]
    return _check(_libc.syscall(ctypes.c_long(number), *wide), name)


def _check(result: int, what: str) -> int:
    if result < 0:
        number = ctypes.get_errno()
        raise OSError(number, f"{what}: {os.strerror(number)}")
    return result


if __name__ == "__main__":
    main()

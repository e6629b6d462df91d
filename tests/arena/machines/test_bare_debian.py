"""The Dockerfile's steps on a machine with only Debian's base packages: the launcher installs everything else.

Takes a minute and a half on two cores when all downloads are there already, and some minutes the first time. Those of
debootstrap, apt and uv are kept (build/bare_machine, uv's own cache).
"""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

from ros_runtime.project import PROJECT

MIRROR = "http://deb.debian.org/debian"
KEPT = PROJECT / "build/bare_machine"
# The variables of this machine's environment that configure the network.
NETWORK = {"PIP_INDEX_URL", "UV_INDEX_URL", "UV_DEFAULT_INDEX"}
NETWORK |= {name for name in os.environ if name.lower().endswith("_proxy")}
# The certificates of a network with its own certificate authority.
CERTIFICATES = os.environ.get("SSL_CERT_FILE") or os.environ.get("PIP_CERT")
COPIED = "/opt/course"
CORRECT = min(path.name for path in (PROJECT / "solutions/patterns/known/correct").glob("*.py"))

MISSING = [program for program in ("debootstrap", "bwrap") if not shutil.which(program)]
pytestmark = [
    pytest.mark.skipif(os.geteuid() != 0, reason="only root can make and enter another root folder"),
    pytest.mark.skipif(
        bool(MISSING), reason=f"missing: {', '.join(MISSING)}; root gets them from ./course test"
    ),
]


def instructions() -> list[tuple[str, str]]:
    """The Dockerfile, line by line."""
    lines = (PROJECT / ".devcontainer/Dockerfile").read_text().splitlines()
    return [tuple(line.split(maxsplit=1)) for line in lines if line and not line.startswith("#")]  # type: ignore[misc]


class Machine:
    """A Debian in a folder, entered like a container."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.user: list[str] = []
        self.home = "/root"

    def run(self, line: str) -> subprocess.CompletedProcess[str]:
        """Run a shell line in it, with network, and with the caches of packages."""
        binds = {KEPT / "apt": "/var/cache/apt/archives", Path.home() / ".cache/uv": "/root/.cache/uv"}
        command = ["bwrap", "--bind", str(self.root), "/"]
        command += [
            "--proc",
            "/proc",
            "--dev",
            "/dev",
            "--unshare-pid",
            "--die-with-parent",
            "--cap-add",
            "ALL",
        ]
        for source, place in binds.items():
            source.mkdir(parents=True, exist_ok=True)
            command += ["--bind", str(source), place]
        command += ["--ro-bind", str(Path("/etc/resolv.conf").resolve()), "/etc/resolv.conf"]
        environment = {name: os.environ[name] for name in NETWORK if name in os.environ}
        environment |= {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": self.home}
        if CERTIFICATES:
            command += ["--ro-bind", CERTIFICATES, "/network.crt"]
            environment |= {"SSL_CERT_FILE": "/network.crt", "PIP_CERT": "/network.crt"}
        return subprocess.run(
            [*command, "--", *self.user, "/bin/sh", "-c", f"cd {shlex.quote(self.home)} && {line}"],
            env=environment,
            capture_output=True,
            text=True,
            check=False,
            timeout=1500,
        )

    def become(self, user: str) -> None:
        """Run further commands as this user, as after USER."""
        ids = self.run(f"id -u {user} && id -g {user}").stdout.split()
        self.user = ["setpriv", f"--reuid={ids[0]}", f"--regid={ids[1]}", "--clear-groups"]
        self.home = f"/home/{user}"

    def copy_clone(self, place: str) -> None:
        """Copy the files that COPY would copy: those of the clone that git does not ignore."""
        listed = ["git", "-C", str(PROJECT), "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
        names = subprocess.run(listed, capture_output=True, text=True, check=True).stdout.split("\0")
        for name in filter(None, names):
            if (PROJECT / name).is_file():
                target = self.root / place.lstrip("/") / name
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(PROJECT / name, target)


def do(*command: str | Path) -> None:
    """Run a program of this machine, not of the Debian in the folder; it must succeed."""
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=900)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr


@pytest.fixture
def machine(tmp_path: Path) -> Iterator[Machine]:
    root = tmp_path / "root"
    _, image = instructions()[0]
    release = {"debian:12": "bookworm"}[image]
    base = KEPT / f"{release}.tar"
    if not base.exists():
        (KEPT / "packages").mkdir(parents=True, exist_ok=True)
        do("debootstrap", "--variant=minbase", f"--cache-dir={KEPT / 'packages'}", release, root, MIRROR)
        do("tar", "-C", root, "-cf", base.with_suffix(".part"), ".")
        base.with_suffix(".part").rename(base)
    else:
        root.mkdir()
        do("tar", "-C", root, "-xf", base)
    yield Machine(root)
    shutil.rmtree(root)


def test_each_step_of_the_dockerfile_and_a_students_first_check(machine: Machine) -> None:
    for word, rest in instructions()[1:]:
        if word == "COPY":
            assert rest == f". {COPIED}"
            machine.copy_clone(COPIED)
        elif word == "RUN":
            ran = machine.run(rest)
            assert ran.returncode == 0, f"RUN {rest}\n{ran.stdout[-2000:]}\n{ran.stderr[-4000:]}"
        elif word == "USER":
            machine.become(rest)
    launcher = f"{COPIED}/course"

    served = machine.run(f"{launcher} lab --version && ls humanoid_course/exercises/patterns")
    assert served.returncode == 0, served.stdout + served.stderr
    assert "patterns.ipynb" in served.stdout
    assert "missing system packages" not in served.stderr

    solution = f"{COPIED}/solutions/patterns/known/correct/{CORRECT}"
    checked = machine.run(f"{launcher} check patterns {solution}")
    assert checked.returncode == 0, checked.stdout + checked.stderr

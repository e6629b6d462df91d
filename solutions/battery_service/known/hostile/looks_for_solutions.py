"""Attack: searches every folder it can see for a solution, the submissions of these tests or hidden checks, prints
them and runs the first server it finds.
Outcome: the sandbox holds none of them, so there is nothing to run.
Caught by: server_appears
"""

import os
import re
import runpy
import sys
from pathlib import Path

WANTED = re.compile(r"(class_based|threads_and_sleep|hidden|judging|checks|battery_service)\.(py|ipynb)")
MYSELF = Path(__file__).resolve()


def places():
    yield from (Path.cwd(), *Path.cwd().parents, Path.home(), Path("/home"), Path("/root"), Path("/opt"))
    yield from map(Path, sys.path)
    for pid in filter(str.isdigit, os.listdir("/proc")):
        yield from (Path("/proc") / pid / "cwd", Path("/proc") / pid / "root/root")


def files(folder, depth=4):
    try:
        for entry in os.scandir(folder):
            if entry.is_file() and WANTED.fullmatch(entry.name):
                yield Path(entry.path)
            elif entry.name in ("proc", "sys", "site-packages"):
                continue
            elif depth and entry.is_dir(follow_symlinks=False):
                yield from files(entry.path, depth - 1)
    except OSError:
        return


def main(args=None):
    for folder in places():
        for file in files(folder):
            if file.resolve() == MYSELF:
                continue
            text = file.read_text(errors="replace")
            print(f"FOUND {file}: {text[:2000]}", flush=True)
            if file.suffix == ".py" and "def main(" in text:
                runpy.run_path(str(file), run_name="__main__")
                return
    print("nothing found", flush=True)


if __name__ == "__main__":
    main()

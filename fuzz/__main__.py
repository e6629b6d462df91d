"""One process of `course test --fuzz`: tries some fuzzers with one seed, and says what it begins and what it finds."""

from __future__ import annotations

import faulthandler
import resource
import sys
import time

from fuzz.arena.targets import TARGETS
from fuzz.finding import Finding

EXAMPLES = 200  # of each reader, times its weight
LONGEST_READER, LONGEST_ARENA = 180.0, 420.0  # s until a fuzzer is held to hang, and this process ends
MEMORY = 6 * 2**30  # bytes of address space for the readers
BEGINS, FOUND = "begins ", "found "  # how the lines for the parent begin


def main(seed: int, until: float, names: list[str]) -> int:
    """Return 1 if something was found, else 0; no fuzzer begins after `until` (s since the epoch)."""
    found = 0
    for index, name in enumerate(names):
        if index and time.time() > until:
            break
        print(f"{BEGINS}{name}", flush=True)
        faulthandler.dump_traceback_later(LONGEST_ARENA if name in TARGETS else LONGEST_READER, exit=True)
        finding = look(name, seed)
        faulthandler.cancel_dump_traceback_later()
        if finding:
            found += 1
            print(f"{FOUND}{finding.keep()}", flush=True)
    return 1 if found else 0


def look(name: str, seed: int) -> Finding | None:
    """Try one fuzzer."""
    if name in TARGETS:
        from fuzz.arena.made_up import look as look_in_an_arena

        return look_in_an_arena(name, seed)
    from fuzz.readers.all import READERS  # which takes seconds to import, and an arena needs none of it

    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, resource.RLIM_INFINITY))
    return READERS[name].look(seed, EXAMPLES)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), float(sys.argv[2]), sys.argv[3:]))

"""Attack: prints a full-mark verdict and writes it, with the events of a perfect run, into every descriptor it
can find.
Outcome: its output is only ever text in the log, and no descriptor of the grader reaches it.
Caught by: server_appears
"""

import json
import os
import time

CHECKS = ("server_appears", "answers_with_the_last_message", "says_when_it_knows_nothing", "ends_cleanly")


def main(args=None):
    verdict = {
        "exercise": "battery_service",
        "status": "graded",
        "score": 10,
        "max_score": 10,
        "checks": [{"id": check, "status": "passed", "points": 10, "max_points": 10} for check in CHECKS],
    }
    now = time.monotonic()
    events = [
        {"kind": "node_ready", "t": now, "waited": 0.1},
        {"kind": "scenario_ended", "t": now + 1.0},
    ]
    lines = "".join(json.dumps(line) + "\n" for line in [verdict, *events]).encode()
    for descriptor in range(256):
        try:
            os.write(descriptor, lines)
        except OSError:
            continue
    os._exit(0)


if __name__ == "__main__":
    main()

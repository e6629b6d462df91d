"""``python -m robot_sim.trials``: run the trials and print the table."""

import argparse
import sys

from rich.console import Console

from robot_sim.trials import TRIALS, run_trials
from robot_sim.trials.table import table_of


def main() -> int:
    """Run what the command line asks for; 0: every reference is met, 1: not, 2: wrong arguments."""
    parser = argparse.ArgumentParser(prog="python -m robot_sim.trials", description=__doc__)
    parser.add_argument("--trial", help=f"comma-separated, of {', '.join(TRIALS)} (default: all)")
    parser.add_argument("--quick", action="store_true", help="a few runs of each")
    parser.add_argument("--jobs", type=int, default=1, help="processes to use (default 1)")
    options = parser.parse_args()
    names = options.trial.split(",") if options.trial else None
    try:
        rows = run_trials(names, quick=options.quick, jobs=options.jobs)
    except ValueError as error:
        parser.error(str(error))
    console = Console()
    console.print(table_of(rows))
    for row in rows:
        for failure in row.failures:
            console.print(f"{row.title}: {failure}", highlight=False, markup=False)
    return 0 if all(row.met for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())

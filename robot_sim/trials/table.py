"""The table of the trials."""

import math
from collections.abc import Sequence

from rich.table import Table

from robot_sim.trials.trial import Summary


def table_of(rows: Sequence[Summary]) -> Table:
    """The rows as a rich table."""
    table = Table(title="The humanoid's trials")
    for heading in ("Trial", "Success", "Measured", "Reference", "CPU factor", "Met"):
        table.add_column(heading, justify="right" if heading in ("Success", "CPU factor") else "left")
    for row in rows:
        factor = "" if math.isnan(row.real_time_factor) else f"{row.real_time_factor:.0f}x"
        met = "[green]yes[/green]" if row.met else "[red]no[/red]"
        table.add_row(row.title, f"{row.successes}/{row.runs}", row.measured, row.reference, factor, met)
    return table

"""Mistakes that are one expression in the place of another: the pattern, and what beginners write instead.

In a pattern a single capital letter is any expression (`autograder.audit.generated.pattern`).
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from autograder.audit.generated.pattern import filled, match, parsed
from autograder.audit.generated.program import Edits, Program

Rewrites = dict[str, list[str]]  # what beginners write, by the pattern; the first pattern that matches counts

_ENDS = ("succeed", "abort", "canceled")
_LESS = ("<", "<=")
_NAMED = {
    call: call.replace("N", "'/' + N")
    for call in (
        "X.create_subscription(T, N, *R, **K)",
        "X.create_publisher(T, N, *R, **K)",
        "X.create_service(T, N, *R, **K)",
        "X.create_client(T, N, *R, **K)",
        "ActionServer(X, T, N, *R, **K)",
        "ActionClient(X, T, N, *R, **K)",
    )
}

REWRITES: dict[str, tuple[str, Rewrites]] = {
    "misses_a_cancel": ("A cancel is not looked for", {"X.is_cancel_requested": ["False"]}),
    "ends_otherwise": (
        "A goal ends with another status",
        {
            quoted.format(end): [quoted.format(other) for other in _ENDS if other != end]
            for end in _ENDS
            for quoted in ("X.{}", "'{}'")
        },
    ),
    "answers_otherwise": (
        "A goal or a cancel gets the other answer",
        {"X.ACCEPT": ["X.REJECT"], "X.REJECT": ["X.ACCEPT"]},
    ),
    "takes_the_code_for_the_status": (
        "A goal counts as succeeded when its result has no error code",
        {
            "X.status == GoalStatus.STATUS_SUCCEEDED": ["X.result.error_code == 0"],
            "status == GoalStatus.STATUS_SUCCEEDED": ["result.error_code == 0"],
        },
    ),
    "counts_from_the_start": (
        "A count goes on from goal to goal instead of beginning with each",
        {"X.steps - Y": ["X.steps"]},
    ),
    "leaves_an_angle_unwrapped": (
        "An angle is not brought back to -π to π",
        {"atan2(sin(X), cos(X))": ["X"], "wrap(X)": ["X"], "remainder(X, Y)": ["X"]},
    ),
    "limits_each_axis": (
        "A limit holds for each axis, or for one, instead of for the norm",
        {
            "hypot(X, Y)": ["max(abs(X), abs(Y))", "abs(X)", "abs(Y)"],
            "hypot(X, Y, Z)": ["max(abs(X), abs(Y), abs(Z))", "abs(X)"],
        },
    ),
    "lets_nan_through": (
        "NaN or infinity is not looked for",
        {
            "isfinite(X)": ["True"],
            "isnan(X)": ["False"],
            "isinf(X)": ["False"],
            "map(isfinite, X)": ["[True]"],
        },
    ),
    "prints_to_the_other_stream": (
        "What belongs on stdout is printed on stderr, or the other way round",
        {
            "print(*R)": ["print(*R, file=__import__('sys').stderr)"],
            "print(*R, flush=True)": ["print(*R, file=__import__('sys').stderr)"],
            "X.stderr": ["X.stdout"],
            "X.stdout": ["X.stderr"],
        },
    ),
    "makes_a_name_absolute": (
        "A name begins with a slash, so that the namespace does not count",
        {call: [absolute] for call, absolute in _NAMED.items()},
    ),
    "takes_the_usual_qos": (
        "The quality of service is not the one that the topic needs",
        {"X.TRANSIENT_LOCAL": ["X.VOLATILE"], "qos_profile_sensor_data": ["10"]},
    ),
    "collapses_duplicates": (
        "What is asked for twice is answered once",
        {f"request.{names}": [f"list(dict.fromkeys(request.{names}))"] for names in ("names", "joint_names")},
    ),
    "looks_at_the_first_only": (
        "Only the first of several is looked at",
        {
            f"{all_}({each.format('Z')})": [f"{all_}({each.format('list(Z)[:1]')})"]
            for all_ in ("all", "any")
            for each in ("X for Y in {}", "map(F, {})")
        },
    ),
    "forgets_one_of_several": (
        "One of several conditions or states is forgotten",
        {
            "X and Y": ["X", "Y"],
            "X and Y and Z": ["Y and Z", "X and Z", "X and Y"],
            "X or Y": ["X", "Y"],
            "X or Y or Z": ["Y or Z", "X or Z", "X or Y"],
            "X in (Y, Z)": ["X == Y", "X == Z"],
            "X not in (Y, Z)": ["X != Y", "X != Z"],
            "X in (Y, *R)": ["X in (*R,)"],
            "X not in (Y, *R)": ["X not in (*R,)"],
            "map(F, (X, *R))": ["map(F, (*R,))"],
        }
        | {f"X {one} Y {other} Z": [f"X {one} Y", f"Y {other} Z"] for one in _LESS for other in _LESS},
    ),
    "turns_the_sign": (
        "A term of a sum has the wrong sign",
        {
            f"{term} {sign} Z": [f"{term} {other} Z"]
            for term in ("X * Y", "X.x", "X.y", "X.z", "X.w")
            for sign, other in ("+-", "-+")
        },
    ),
}


def rewritten(program: Program, rewrites: Rewrites) -> Iterator[Edits]:
    """Yield the edits of all places that a pattern matches."""
    patterns = [(parsed(pattern), wrong) for pattern, wrong in rewrites.items()]
    for node in program.every(ast.expr):
        found = [(bound, wrong) for pattern, wrong in patterns if (bound := match(pattern, node)) is not None]
        for replacement in found[0][1] if found else ():
            yield {node: filled(replacement, found[0][0])}

"""A table of mistakes that replace one expression by another.

Each mistake has a name and a sentence, then its patterns, each with the expressions that beginners write instead. Only
the first pattern that matches counts. In a pattern a single capital letter stands for any expression
(`autograder.classroom.audit.generated.pattern`).
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from autograder.classroom.audit.generated.pattern import filled, match, parsed
from autograder.classroom.audit.generated.program import Edits, Program

_TABLE = """
misses_a_cancel: The program does not check for a cancel request
    X.is_cancel_requested → False
ends_otherwise: A goal ends with the wrong status
    X.succeed → X.abort; X.canceled
    X.abort → X.succeed; X.canceled
    X.canceled → X.succeed; X.abort
    'succeed' → 'abort'; 'canceled'
    'abort' → 'succeed'; 'canceled'
    'canceled' → 'succeed'; 'abort'
answers_otherwise: A goal or a cancel request is accepted instead of rejected, or the reverse
    X.ACCEPT → X.REJECT
    X.REJECT → X.ACCEPT
takes_the_code_for_the_status: A goal counts as succeeded when its result has no error code
    X.status == GoalStatus.STATUS_SUCCEEDED → X.result.error_code == 0
    status == GoalStatus.STATUS_SUCCEEDED → result.error_code == 0
counts_from_the_start: A count is not restarted for each goal
    X.steps - Y → X.steps
leaves_an_angle_unwrapped: An angle is not wrapped to the range from -π to π
    atan2(sin(X), cos(X)) → X
    wrap(X) → X
    remainder(X, Y) → X
limits_each_axis: A limit applies to each axis, or to one axis, instead of the norm
    hypot(X, Y) → max(abs(X), abs(Y)); abs(X); abs(Y)
    hypot(X, Y, Z) → max(abs(X), abs(Y), abs(Z)); abs(X)
lets_nan_through: The program does not check for NaN or infinity
    isfinite(X) → True
    isnan(X) → False
    isinf(X) → False
    map(isfinite, X) → [True]
prints_to_the_other_stream: A line for stdout is printed to stderr, or the reverse
    print(*R) → print(*R, file=__import__('sys').stderr)
    print(*R, flush=True) → print(*R, file=__import__('sys').stderr)
    X.stderr → X.stdout
    X.stdout → X.stderr
makes_a_name_absolute: A name begins with a slash, so that the namespace is ignored
    X.create_subscription(T, N, *R, **K) → X.create_subscription(T, '/' + N, *R, **K)
    X.create_publisher(T, N, *R, **K) → X.create_publisher(T, '/' + N, *R, **K)
    X.create_service(T, N, *R, **K) → X.create_service(T, '/' + N, *R, **K)
    X.create_client(T, N, *R, **K) → X.create_client(T, '/' + N, *R, **K)
    ActionServer(X, T, N, *R, **K) → ActionServer(X, T, '/' + N, *R, **K)
    ActionClient(X, T, N, *R, **K) → ActionClient(X, T, '/' + N, *R, **K)
takes_the_usual_qos: The quality of service is not the one that the topic needs
    X.TRANSIENT_LOCAL → X.VOLATILE
    qos_profile_sensor_data → 10
collapses_duplicates: A name that is requested twice is answered once
    request.names → list(dict.fromkeys(request.names))
    request.joint_names → list(dict.fromkeys(request.joint_names))
looks_at_the_first_only: Only the first of several items is checked
    all(X for Y in Z) → all(X for Y in list(Z)[:1])
    any(X for Y in Z) → any(X for Y in list(Z)[:1])
    all(map(F, X)) → all(map(F, list(X)[:1]))
    any(map(F, X)) → any(map(F, list(X)[:1]))
forgets_one_of_several: One of several conditions or values is left out
    X and Y → X; Y
    X and Y and Z → Y and Z; X and Z; X and Y
    X or Y → X; Y
    X or Y or Z → Y or Z; X or Z; X or Y
    X < Y < Z → X < Y; Y < Z
    X < Y <= Z → X < Y; Y <= Z
    X <= Y < Z → X <= Y; Y < Z
    X <= Y <= Z → X <= Y; Y <= Z
    X in (Y, Z) → X == Y; X == Z
    X not in (Y, Z) → X != Y; X != Z
    X in (Y, *R) → X in (*R,)
    X not in (Y, *R) → X not in (*R,)
    map(F, (X, *R)) → map(F, (*R,))
turns_the_sign: A term of a sum has the wrong sign
    X * Y + Z → X * Y - Z
    X * Y - Z → X * Y + Z
    X.x + Z → X.x - Z
    X.x - Z → X.x + Z
    X.y + Z → X.y - Z
    X.y - Z → X.y + Z
    X.z + Z → X.z - Z
    X.z - Z → X.z + Z
"""

Rewrites = list[tuple[ast.expr, list[str]]]  # each pattern with its replacements


def rewrites() -> dict[str, tuple[str, Rewrites]]:
    """Return the sentence and the patterns of each mistake, by the mistake's name."""
    found: dict[str, tuple[str, Rewrites]] = {}
    for mistake in re.split(r"\n(?! )", _TABLE.strip()):
        head, *rows = mistake.splitlines()
        name, _, sentence = head.partition(": ")
        pairs = [row.strip().partition(" → ")[::2] for row in rows]
        found[name] = sentence, [(parsed(pattern), instead.split("; ")) for pattern, instead in pairs]
    return found


def rewritten(program: Program, instead: Rewrites) -> Iterator[Edits]:
    """Yield one edit for each replacement, at every place that a pattern matches."""
    for node in program.every(ast.expr):
        found = [(bound, new) for pattern, new in instead if (bound := match(pattern, node)) is not None]
        for bound, new in found[:1]:
            for one in new:
                yield {node: filled(one, bound)}

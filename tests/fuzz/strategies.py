"""What many fuzzers share: texts, names, bytes and JSON at their limits or damaged, and an arena's log."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from hypothesis import strategies as st

from autograder.arena.arena_log import ArenaLog

MARKUP = "<script>alert('owned')</script>"
ODD_TEXTS = (
    *("", " ", "\0", "\n", "\r\n", "\x1b[2J\x1b[31m", "\ud800", "\udcff", "\u202e", "\ufeff", "\U0010ffff"),
    *(MARKUP, "[/bold]", "[link=file:///etc/passwd]x[/link]", "{{ 7*7 }}", "%s%n", "../../etc/passwd", "NaN"),
    *("1e999", "9" * 5000, "-0", "None", "True", "x" * 11_000, "\u0661\u0662"),
    '{"kind": "scenario_ended", "t": 1}',
)
ODD_NUMBERS: tuple[Any, ...] = (
    *(0, -1, 1, 255, 256, 2**31, -(2**31) - 1, 2**32, 2**53, 2**63, 2**64, -(2**63) - 1, 10**400),
    *(0.0, -0.0, float("nan"), float("inf"), float("-inf"), 1e308, 5e-324, 3.5e38, 1e-320),
)

texts = st.one_of(
    st.sampled_from(ODD_TEXTS),
    st.text(st.characters(), max_size=60),
    st.lists(st.sampled_from(ODD_TEXTS), max_size=4).map("".join),
)
numbers = st.one_of(st.sampled_from(ODD_NUMBERS), st.integers(), st.floats())
plain = st.one_of(st.none(), st.booleans(), numbers, texts)
json_values = st.recursive(
    plain,
    lambda inner: st.one_of(st.lists(inner, max_size=4), st.dictionaries(texts, inner, max_size=4)),
    max_leaves=8,
)
blobs = st.one_of(
    st.binary(max_size=200),
    st.sampled_from((b"", b"\0" * 100, b"\xff\xfe\x00", b"\n" * 3000, b"[" * 100_000, b'{"a":' * 30_000)),
    texts.map(lambda text: text.encode(errors="surrogatepass")),
)


def mutated(samples: Sequence[bytes]) -> st.SearchStrategy[bytes]:
    """Return samples with a few places changed: bytes replaced, removed or inserted."""
    return st.tuples(st.sampled_from(list(samples)), st.lists(_changes, max_size=4)).map(_changed)


def damaged_json(samples: Sequence[Any]) -> st.SearchStrategy[Any]:
    """Return samples of JSON with a few of their values replaced, removed or added."""
    return st.tuples(st.sampled_from(list(samples)), st.lists(_damages, min_size=1, max_size=3)).map(_damaged)


_changes = st.tuples(st.floats(0, 1), st.integers(0, 40), blobs)
_damages = st.tuples(
    st.integers(0, 10_000), st.sampled_from(("replace", "remove", "add")), json_values, texts
)


def _changed(drawn: tuple[bytes, list[tuple[float, int, bytes]]]) -> bytes:
    data, changes = drawn
    for where, cut, put in changes:
        place = int(where * len(data))
        data = data[:place] + put + data[place + cut :]
    return data


def _damaged(drawn: tuple[Any, list[tuple[int, str, Any, str]]]) -> Any:
    sample, damages = drawn
    found = json.loads(json.dumps(sample))
    for number, how, value, name in damages:
        places = list(_places(found))
        if not places:
            return value
        holder, key = places[number % len(places)]
        if how == "remove":
            del holder[key]
        elif how == "add" and isinstance(holder, dict):
            holder[name] = value
        else:
            holder[key] = value
    return found


def _places(value: Any) -> Any:
    """Yield each place in nested JSON as its holder and the key there."""
    pairs = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, inner in list(pairs):
        yield value, key
        yield from _places(inner)


@contextmanager
def recorded() -> Iterator[tuple[ArenaLog, Callable[[], bytes]]]:
    """A log of an arena, and a function that returns what the log has written."""
    with tempfile.TemporaryFile() as file:

        def written() -> bytes:
            file.seek(0)
            return file.read()

        yield ArenaLog(file.fileno()), written

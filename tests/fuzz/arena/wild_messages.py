"""ROS messages of any type with random values. The generated program contains a copy of this text."""

from __future__ import annotations

import random
import re
from importlib import import_module
from typing import Any

ODD_FLOATS = (0.0, -0.0, 1.0, 1e308, -1e308, 5e-324, 3.4e38, float("nan"), float("inf"), float("-inf"))
ODD_STRINGS = (
    *("", "odom", "\x00", "\x1b[2J", "<script>alert(1)</script>", "é" * 40, "{}"),
    *("x" * 12_000, "\n", "9" * 5000),
)
SEQUENCE = re.compile(r"sequence<(?P<of>.+?)(?:, *(?P<most>\d+))?>|(?P<element>.+?)\[(?P<length>\d+)\]")
DEPTH = 4


def wild_message(kind: Any, chance: random.Random, depth: int = 0) -> Any:
    """Return a message of this type, each field at its default or odd."""
    message = kind()
    for name, declared in kind.get_fields_and_field_types().items():
        if chance.random() < 0.8:
            inner = getattr(message, name)
            nested = hasattr(inner, "get_fields_and_field_types")
            if nested and depth < DEPTH:
                setattr(message, name, wild_message(type(inner), chance, depth + 1))
            elif not nested:
                setattr(message, name, wild_value(declared, chance, depth))
    return message


def wild_value(declared: str, chance: random.Random, depth: int) -> Any:
    """Return a value that fits the declared type of a field."""
    if many := SEQUENCE.fullmatch(declared):
        if many["length"]:
            length = int(many["length"])
        else:
            length = chance.choice((0, 1, 2, 3, 3, 30, 3000) if depth < 2 else (0, 1))
            length = min(length, int(many["most"] or 3000))
        of = many["of"] or many["element"]
        one = [wild_value(of, chance, depth + 1) for _ in range(min(length, 3))]
        return [one[index % len(one)] for index in range(length)] if one else []
    if "/" in declared:
        package, name = declared.split("/")[0], declared.split("/")[-1]
        kind = getattr(import_module(f"{package}.msg"), name)
        return wild_message(kind, chance, depth + 1) if depth < DEPTH else kind()
    if declared == "boolean":
        return chance.random() < 0.5
    if declared == "float":
        number = chance.choice((*ODD_FLOATS, chance.uniform(-10, 10)))
        return 1.0 if 3.4e38 <= abs(number) < float("inf") else number  # no float of 32 bits holds it
    if declared == "double":
        return chance.choice((*ODD_FLOATS, chance.uniform(-10, 10)))
    if declared.startswith(("string", "wstring")):
        bound = re.search(r"<(\d+)>", declared)
        text = chance.choice(ODD_STRINGS)
        return text[: int(bound[1])] if bound else text
    if declared in ("octet", "byte"):
        return bytes([chance.randrange(256)])
    bits, is_signed = int(declared.partition("int")[2]), declared.startswith("int")
    least, most = (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) if is_signed else (0, 2**bits - 1)
    return chance.choice((0, 1, least, most, chance.randint(least, most)))

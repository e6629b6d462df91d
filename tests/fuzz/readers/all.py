"""All fuzzers of readers by name."""

from __future__ import annotations

from collections.abc import Mapping

from fuzz.fuzzer import Fuzzer
from fuzz.readers import arena_report, essay, graph, handed_in, judging, output, records

MODULES = (arena_report, graph, handed_in, essay, output, judging, records)
READERS: Mapping[str, Fuzzer] = {fuzzer.name: fuzzer for module in MODULES for fuzzer in module.FUZZERS}
CHANNELS = ("topics", "graph", "answers", "feedback", "files", "output", "records")

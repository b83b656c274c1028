"""Inputs guided by coverage: libFuzzer through Atheris, if its wheel is installed."""

import importlib
import importlib.util
import random
import sys
from collections.abc import Sequence
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec, SourceFileLoader
from pathlib import Path
from types import CodeType, ModuleType
from typing import Any

from .mutate import Pool, mutate
from .target import Execute

_MAX_BYTES = 200_000
_BYTES_RATIO = 0.25
"""Ratio of mutations by libFuzzer, which knows compared values."""
_SEEDS_RATIO = 0.1
"""Ratio of mutations that start from a seed."""


def is_installed() -> bool:
    """Return whether Atheris is installed."""
    return importlib.util.find_spec("atheris") is not None


def instrument() -> bool:
    """Count edges of all of Trundle's modules that are imported later; return False without Atheris."""
    if not is_installed():
        return False
    sys.meta_path.insert(0, _InstrumentingFinder())
    return True


class _InstrumentingFinder(MetaPathFinder):
    """Finds Trundle's modules through the other finders; Atheris' finder cannot find modules of editable installs."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None, /
    ) -> ModuleSpec | None:
        if fullname.partition(".")[0] != "trundle":
            return None
        others = (finder for finder in sys.meta_path if finder is not self)
        spec = next((spec for finder in others if (spec := finder.find_spec(fullname, path, target)) is not None), None)
        if spec is not None and spec.origin is not None and spec.origin.endswith(".py"):
            spec.loader = _InstrumentingLoader(fullname, spec.origin)
        return spec


class _InstrumentingLoader(SourceFileLoader):
    def get_code(self, fullname: str) -> CodeType | None:
        code = super().get_code(fullname)
        return None if code is None else _atheris().patch_code(code, trace_dataflow=True)


def _atheris() -> Any:
    return importlib.import_module("atheris")


def run(execute: Execute, pool: Pool, *, corpus: Path, seeds: Path, seconds: float) -> None:
    """Feed inputs for some seconds, then end the process.

    Args:
        execute: function that is called with each input.
        pool: material of mutations.
        corpus: folder of inputs that reached new edges, to which inputs are added.
        seeds: folder of further inputs.
        seconds: duration [s].
    """
    engine = _atheris()

    def mutated(data: bytes, max_size: int, seed: int) -> bytes:
        source = random.Random(seed)
        if len(data) <= 1 or source.random() < _SEEDS_RATIO:  # targets without Python code have no corpus
            data = source.choice(pool.inputs)
        if source.random() < _BYTES_RATIO:
            return engine.Mutate(data, max_size)
        return mutate(data, pool, source)[:max_size]

    options = [
        f"-max_total_time={max(1, round(seconds))}", f"-max_len={_MAX_BYTES}", "-len_control=0", "-rss_limit_mb=0",
        "-timeout=1000000", "-detect_leaks=0", "-reload=0", f"-artifact_prefix={seeds.parent}/",
    ]  # fmt: skip
    engine.Setup([sys.argv[0], *options, str(corpus), str(seeds)], execute, custom_mutator=mutated)
    engine.Fuzz()

"""Inputs guided by coverage: libFuzzer, by Atheris, where its wheel is installed."""

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
"""Part of the mutations that libFuzzer makes, which knows compared values."""
_SEEDS_RATIO = 0.1
"""Part of the mutations that start from a seed."""


def is_installed() -> bool:
    """True if Atheris is there."""
    return importlib.util.find_spec("atheris") is not None


def instrument() -> bool:
    """Count edges of every module of Trundle that is imported from now on; False without Atheris."""
    if not is_installed():
        return False
    sys.meta_path.insert(0, _InstrumentingFinder())
    return True


class _InstrumentingFinder(MetaPathFinder):
    """Finds Trundle's modules where others find them; Atheris' own finder does not reach those of editable installs."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None, /
    ) -> ModuleSpec | None:
        if fullname.partition(".")[0] != "trundle":
            return None
        others = (finder for finder in sys.meta_path if finder is not self)
        spec = next((spec for each in others if (spec := each.find_spec(fullname, path, target)) is not None), None)
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
    """Feed inputs for some seconds; ends the process.

    Args:
        execute: takes each input.
        pool: what mutations put in.
        corpus: folder of inputs that reached new edges; it grows.
        seeds: folder of further ones.
        seconds: duration [s].
    """
    engine = _atheris()

    def mutated(data: bytes, max_size: int, seed: int) -> bytes:
        source = random.Random(seed)
        if len(data) <= 1 or source.random() < _SEEDS_RATIO:  # nothing is kept of targets that are not Python
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

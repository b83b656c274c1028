"""Digest of all inputs of a sweep."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from trundle.robots.model import World

from ..input_digest import input_digest
from .plan import Plan


@dataclass(frozen=True, slots=True, kw_only=True)
class RunInputs:
    """Inputs of a run besides the plan."""

    worlds: tuple[World, ...]
    """Worlds and spawned models, as read."""
    texts: tuple[str, ...] = ()
    files: tuple[Path, ...] = ()


def plan_digest(plan: Plan, inputs: Iterable[RunInputs]) -> str:
    """Return a digest of everything that may change a row; `inputs` are the inputs of `argument_rows`."""
    texts, worlds = [plan.text], list[World]()
    files = {item.function[0] for item in plan.measures if item.function is not None}
    for item in inputs:
        texts += item.texts
        worlds += item.worlds
        files |= {*item.files}
    return input_digest(texts, worlds, files)

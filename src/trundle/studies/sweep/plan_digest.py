"""Digest of everything that the results of a sweep depend on."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from trundle.robots.model import World

from ..input_digest import input_digest
from .plan import Plan


@dataclass(frozen=True, slots=True, kw_only=True)
class RunInputs:
    """Inputs of a run beside its plan."""

    worlds: tuple[World, ...]
    """Worlds and spawned models, as read."""
    texts: tuple[str, ...] = ()
    files: tuple[Path, ...] = ()


def plan_digest(plan: Plan, inputs: Iterable[RunInputs]) -> str:
    """Return a digest that changes with anything that may change a row; `inputs` are those of `argument_rows`."""
    texts, worlds = [plan.text], list[World]()
    files = {each.function[0] for each in plan.measures if each.function is not None}
    for each in inputs:
        texts += each.texts
        worlds += each.worlds
        files |= {*each.files}
    return input_digest(texts, worlds, files)

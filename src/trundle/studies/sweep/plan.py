"""Plan of a sweep."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal, TypeAlias

from trundle.base.diagnostics import Source
from trundle.studies.plan_files.variation import Variation

Design: TypeAlias = Literal["random", "latin_hypercube", "sobol"]
Over: TypeAlias = Literal["end", "start", "min", "max", "mean", "time"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Formula:
    """Expression of a plan."""

    text: str
    at: Source


@dataclass(frozen=True, slots=True, kw_only=True)
class Measure:
    """Number measured in each run: an expression over states, or a Python function."""

    name: str
    at: Source
    expression: str | None = None
    over: Over = "end"
    """Time of the measure, or statistic of all samples; "time": first time at which the expression is true [s]."""
    function: tuple[Path, str] | None = None
    """File and name of a function that takes the simulation."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Event:
    """Push or joint command at a time of each run."""

    at: Source
    time_s: Formula
    target: tuple[str, str]
    """Model, and its link or joint."""
    kind: Literal["push", "position", "velocity", "effort"]
    numbers: tuple[Formula, ...]
    """Force [N] and torque [N·m], world axes; or the joint's command."""
    duration_s: Formula | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Plan:
    """World, variations and measures."""

    file: str
    """Plan's name in messages."""
    folder: Path
    """Base of relative paths."""
    text: str
    world: str
    """World or description; or, separated by spaces, the launch file or its package and name."""
    world_at: Source
    is_launch: bool = False
    duration_s: float
    every_s: float = 0.1
    """Period at which stop conditions and measures over time are evaluated."""
    time_limit_s: float | None = None
    """Maximum wall time of a run."""
    memory_limit_bytes: int | None = None
    """Maximum resident memory of a run."""
    bag_s: float | None = None
    """Duration at the end of a run that is not ok, saved as a bag [s]; None: no bag."""
    bag_without: frozenset[str] = frozenset()
    """Message types excluded from the bag."""
    seed: int = 0
    seeds: tuple[int, ...] = ()
    """Seed of each repetition; empty: derived from the plan's seed and the row's number."""
    repetitions: int = 1
    samples: int = 1
    """Samples of the distributions at each point of the grid."""
    design: Design = "random"
    plugins: bool = False
    vary: tuple[Variation, ...] = ()
    assignments: Mapping[str, Formula] = field(default_factory=dict[str, Formula])
    """Path of a property → expression of its value."""
    events: tuple[Event, ...] = ()
    stop: tuple[Formula, ...] = ()
    measures: tuple[Measure, ...] = ()
    criteria: tuple[Formula, ...] = ()
    """Conditions on the measures; a run that violates one has failed."""
    keys: Mapping[str, Source] = field(default_factory=dict[str, Source])
    """Key of the plan → source."""

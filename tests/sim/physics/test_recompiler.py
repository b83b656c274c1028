"""Worlds that differ in numbers: the copied model equals that of a full compile bit for bit."""

from collections.abc import Callable

import numpy as np
import pytest

import trundle
from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import World
from trundle.sim.physics import CompiledWorld, Recompiler, compile_world
from trundle.studies.sweep.property_path import with_property

CHASSIS = "models/rp2w/links/chassis"
NUMBERS = {
    "mass": lambda w: with_property(w, f"{CHASSIS}/inertial/mass", 5.5),
    "inertia": lambda w: with_property(w, f"{CHASSIS}/inertial/moments", (0.2, 0.3, 0.4)),
    "inertia of no body": lambda w: with_property(w, f"{CHASSIS}/inertial/moments", (0.1, 0.2, 0.4)),
    "friction": lambda w: with_property(w, "models/rp2w/links/*/collisions/*/friction", 0.31),
    "gravity": lambda w: with_property(w, "gravity", (0.1, 0.0, -3.7)),
    "all": lambda w: NUMBERS["mass"](NUMBERS["friction"](NUMBERS["gravity"](w))),
}
OTHERS = {
    "time step": lambda w: with_property(w, "time_step", 0.002),
    "pose": lambda w: with_property(w, "models/rp2w/pose/z", 0.4),
    "no friction": lambda w: with_property(w, "models/rp2w/links/*/collisions/*/friction", 0.0),
    "shape": lambda w: with_property(w, "models/rp2w/joints/*/axis/damping", 0.25),
}


@pytest.fixture(scope="module")
def world() -> World:
    return trundle.load("model://rp2w").world


def _differences(a: CompiledWorld, b: CompiledWorld) -> list[str]:
    names: list[str] = []
    for owner in ("", "opt", "stat"):
        first, second = ((getattr(world.model, owner) if owner else world.model) for world in (a, b))
        for name in dir(first):
            x = None if name.startswith("_") else getattr(first, name)
            if isinstance(x, np.ndarray | int | float) and not np.array_equal(x, getattr(second, name)):
                names.append(f"{owner}.{name}")
    return names


@pytest.mark.parametrize("edit", NUMBERS.values(), ids=NUMBERS)
def test_numbers_are_written_to_a_copy(world: World, edit: Callable[[World], World]) -> None:
    recompiler = Recompiler()
    recompiler.compile(world, Diagnostics())

    compiled = recompiler.compile(edit(world), Diagnostics())

    assert recompiler.full_compiles == 1
    assert _differences(compiled, compile_world(edit(world), Diagnostics())) == []
    assert _differences(recompiler.compile(world, Diagnostics()), compile_world(world, Diagnostics())) == []


@pytest.mark.parametrize("edit", OTHERS.values(), ids=OTHERS)
def test_other_changes_are_compiled_in_full(world: World, edit: Callable[[World], World]) -> None:
    recompiler = Recompiler()
    recompiler.compile(world, Diagnostics())

    compiled = recompiler.compile(edit(world), Diagnostics())

    assert _differences(compiled, compile_world(edit(world), Diagnostics())) == []
    assert recompiler.full_compiles == 2
    recompiler.compile(world, Diagnostics())
    assert recompiler.full_compiles == 2, "the first is kept"

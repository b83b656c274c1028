"""Compiler for a series of similar worlds: if only numbers differ, it writes them to a copy of the last model.

The numbers are masses, inertias along the same axes, damping and friction of joints, surfaces and gravity. The result
equals that of a full compile bit for bit, in a tenth of the time; every other change is a full compile.
"""

import copy
from collections import deque

import mujoco
from msgspec import Struct
from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import Collision, Joint, Link, Model, Surface, World, flattened

from .compiled_world import CompiledWorld
from .compiler import Compiler
from .contact_pairs import pair_friction
from .contact_params import ContactParams, combine_surfaces
from .inertia import principal_inertia, set_constants
from .law_tables import has_row
from .shape_entry import ShapeEntry

_MAX_BASES = 8
"""Maximum number of models kept, for worlds that differ in more, such as in the time step."""


class _NotNumbersError(Exception):
    """Raised for worlds that differ in more than numbers."""


class _Base(Struct, frozen=True, eq=False):
    """Compiled world to copy."""

    compiler: Compiler
    compiled: CompiledWorld
    model: mujoco.MjModel
    """Model before `Compiler.finish`."""
    params: dict[tuple[str, str], ContactParams]


class Recompiler:
    """Compiler with a cache of its last worlds."""

    def __init__(self) -> None:
        self._bases: deque[_Base] = deque(maxlen=_MAX_BASES)
        """Most recently used first."""
        self.full_compiles = 0
        """Number of worlds that were compiled in full."""

    def compile(self, world: World, report: Diagnostics) -> CompiledWorld:
        """Compile a world; equal to `compile_world`.

        Raises:
            DescriptionError: MuJoCo refuses the model.
        """
        world = flattened(world)
        for base in tuple(self._bases):
            try:
                compiled = _renumbered(base, world, report)
            except _NotNumbersError:
                continue
            self._bases.remove(base)
            self._bases.appendleft(base)
            return compiled
        self.full_compiles += 1
        compiler = Compiler(world, report)
        params, model = compiler.compile_model()
        self._bases.appendleft(_Base(compiler, compiler.finish(copy.copy(model), params), model, params))
        return compiler.finish(copy.copy(model), params)


def _renumbered(base: _Base, world: World, report: Diagnostics) -> CompiledWorld:
    """Return the compiled world with the numbers of another one.

    Raises:
        _NotNumbersError: the worlds differ in more than numbers.
    """
    model = copy.copy(base.model)
    changes = _Changes(base, model, report)
    changes.write(world)
    set_constants(model)
    return base.compiler.finish(model, changes.params, world=world, shapes=changes.shapes, like=base.compiled)


class _Changes:
    """Numbers of a world, written to a copy of a model."""

    def __init__(self, base: _Base, model: mujoco.MjModel, report: Diagnostics) -> None:
        self._base = base
        self._model = model
        self._report = report
        self._surfaces: dict[tuple[int, str, str], Surface] = {}
        """Model, `model::link` and collision → its changed surface."""
        self.params = base.params
        self.shapes = base.compiler.shapes

    def write(self, world: World) -> None:
        before = self._base.compiler.world
        physics = replace(before.physics, gravity=world.physics.gravity)
        _expect(
            physics == world.physics
            and len(world.models) == len(before.models)
            and world.joints == before.joints
            and world.name == before.name
        )
        self._model.opt.gravity = world.physics.gravity
        for number, (old, new) in enumerate(zip(before.models, world.models, strict=True)):
            if old is not new:
                self._write_model(number, old, new)
        if self._surfaces:
            self._write_pairs()

    def _write_model(self, number: int, old: Model, new: Model) -> None:
        _expect(replace(new, links=old.links, joints=old.joints) == old)
        _expect(len(old.links) == len(new.links) and len(old.joints) == len(new.joints))
        for link, edited in zip(old.links, new.links, strict=True):
            if link is not edited:
                self._write_link(number, f"{old.name}::{link.name}", link, edited)
        for joint, changed in zip(old.joints, new.joints, strict=True):
            if joint is not changed and joint != changed:
                self._write_joint(f"{old.name}::{joint.name}", joint, changed)

    def _write_link(self, number: int, name: str, old: Link, new: Link) -> None:
        plain = replace(new, inertial=old.inertial, collisions=old.collisions, sensors=old.sensors, lights=old.lights)
        _expect(plain == old and len(old.collisions) == len(new.collisions))
        if old.inertial != new.inertial:
            self._write_inertia(name, old, new)
        for a, b in zip(old.collisions, new.collisions, strict=True):
            if a != b:
                self._add_surface(number, name, a, b)

    def _write_inertia(self, name: str, old: Link, new: Link) -> None:
        node = self._base.compiler.tree.links[name]
        _expect(not node.fixed and not self._base.compiler.tree.loops)
        _, axes, _ = principal_inertia(old, Diagnostics())
        mass, new_axes, moments = principal_inertia(new, self._report)
        _expect(axes == new_axes)
        ratio, body = self._base.compiler.mass_factor(node), self._model.body(name).id
        self._model.body_mass[body] = mass * ratio
        self._model.body_inertia[body] = [moment * ratio for moment in moments]

    def _add_surface(self, number: int, name: str, old: Collision, new: Collision) -> None:
        restored = replace(new, surface=old.surface, laser_retro=old.laser_retro, max_contacts=old.max_contacts)
        _expect(restored == old)
        a, b = old.surface, new.surface
        _expect(replace(b, mu=a.mu, mu2=a.mu2, kp=a.kp, kd=a.kd, restitution=a.restitution) == a)
        self._surfaces[number, name, f"{name}::{old.name}"] = new.surface

    def _write_pairs(self) -> None:
        """Write the parameters of all pairs with a changed surface."""
        _expect(not self._base.compiler.searches)
        self.shapes = [self._with_surface(shape) for shape in self.shapes]
        named = {shape.name: shape for shape in self.shapes}
        self.params = dict(self._base.params)
        for (a, b), old in self._base.params.items():
            first, second = named[a], named[b]
            new = combine_surfaces(first.surface, second.surface, b_fixed=second.fixed, points=old.points)
            if new == old:
                continue
            h = self._model.opt.timestep
            condim, friction = pair_friction(new)
            _expect(condim == pair_friction(old)[0] and has_row(new, h) == has_row(old, h))
            self.params[a, b] = new
            self._model.pair(f"{a} {b}").friction[:] = friction

    def _with_surface(self, shape: ShapeEntry) -> ShapeEntry:
        surface = self._surfaces.get((shape.model, shape.link, shape.collision))
        return shape if surface is None else replace(shape, surface=surface)

    def _write_joint(self, name: str, old: Joint, new: Joint) -> None:
        _expect(replace(new, axis=old.axis, sensors=old.sensors) == old)
        axes = self._base.compiler.joints.axes.get(name, [])
        a, b = old.axis, new.axis
        _expect(a is not None and b is not None and len(axes) == 1 and axes[0].engine_joint == name)
        assert a is not None
        assert b is not None
        _expect(replace(b, damping=a.damping, friction=a.friction) == a and min(b.damping, b.friction) >= 0)
        _expect((a.friction > 0) == (b.friction > 0) and (a.damping > 0) == (b.damping > 0))
        dof = int(self._model.joint(name).dofadr[0])
        self._model.dof_damping[dof], self._model.dof_frictionloss[dof] = b.damping, b.friction


def _expect(only_numbers: bool) -> None:
    if not only_numbers:
        raise _NotNumbersError

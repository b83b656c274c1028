"""Which shapes may touch, and how: Gazebo's rules written as MuJoCo contact pairs.

In Gazebo the smaller friction of two surfaces wins; MuJoCo takes the larger, so each pair states its own. Links
joined by a joint never touch, links of one model only where they say so.

ODE and MuJoCo cannot agree on everything: ODE's friction pyramid becomes an elliptic cone, and max_vel, which limits
how fast ODE corrects depth, does not count: what begins deep is put out (see `separation`), what hits comes up slowly.
"""

from collections.abc import Iterable, Mapping, Sequence
from itertools import combinations, product

import mujoco

from trundle.diagnostics import Diagnostics
from trundle.model import Model

from .compliance import is_soft, pair_name
from .contact_params import ContactParams, contact_params_of, friction_of, is_plain, may_collide
from .kinematic_tree import Tree
from .shapes import CollidesWith, ShapeEntry
from .solver_settings import SOLIMP, contact_solref, limit_solref, sliding_solref

MOST_PAIRS = 2000
"""Of what stands with what moves. Beyond these, shapes meet by MuJoCo's own search: a pair costs about 10 ns a step
whether it meets or not."""
MOST_MOVING_PAIRS = 1000
"""Of what moves: fewer, for that is seldom near one another."""
MOST_GIVING_PAIRS = 20_000
"""Of shapes that give: beyond, they are as hard as all others that meet by search."""
_BITS = 0x7FFFFFFF
_TOUCHING = 1e-9
"""[m] What is set down on a floor touches it from the first step on: MuJoCo wants it to be below its surface."""
_NEVER_FELT = 1e3
"""[m] Deeper than any shape is in another: the two meet and feel nothing before."""


def add_contacts(
    spec: mujoco.MjSpec, shapes: Sequence[ShapeEntry], models: Sequence[Model], tree: Tree, report: Diagnostics
) -> dict[tuple[str, str], ContactParams]:
    """Write a pair for every two shapes that may touch; return how they do."""
    touches: dict[tuple[str, str], ContactParams] = {}
    for shape in shapes:
        shape.geom.contype = shape.geom.conaffinity = 0
    rules = _Rules(models, tree)
    ranks = {mu: -i for i, mu in enumerate(sorted({friction_of(shape.surface) for shape in shapes}))}
    fixed = [shape for shape in shapes if shape.fixed]
    moving = [shape for shape in shapes if not shape.fixed]
    solid = [shape for shape in moving if shape.meets & CollidesWith.MOVING]
    special = _special(shapes, models, tree, h=spec.option.timestep, report=report)
    if len(fixed) * len(moving) > MOST_PAIRS:
        # Planes, which most things stand on, keep their pairs: only a pair can keep what slides from hopping.
        found = [shape for shape in fixed if shape.name not in special and shape.kind is CollidesWith.STANDING]
        finding = [shape for shape in moving if shape.name not in special and shape.meets & CollidesWith.STANDING]
        _let_find(found, finding, h=spec.option.timestep, ranks=ranks)
        _keep_apart(spec, product(finding, found), rules)
        met = {(a.name, b.name) for a, b in product(finding, found)}
        _add_pairs(spec, ((a, b) for a, b in product(moving, fixed) if (a.name, b.name) not in met), rules, touches)
    else:
        _add_pairs(spec, product(moving, fixed), rules, touches)
    if len(solid) * (len(solid) - 1) <= 2 * MOST_MOVING_PAIRS:
        _add_pairs(spec, combinations(solid, 2), rules, touches)
        return touches
    plain = [shape for shape in solid if shape.name not in special]
    others = [shape for shape in solid if shape.name in special]
    _add_pairs(spec, product(others, plain), rules, touches)
    _add_pairs(spec, combinations(others, 2), rules, touches)
    _let_search(plain, h=spec.option.timestep, ranks=ranks)
    by_model: dict[int, list[ShapeEntry]] = {}
    for shape in plain:
        by_model.setdefault(shape.model, []).append(shape)
    _keep_apart(spec, (pair for own in by_model.values() for pair in combinations(own, 2)), rules)
    return touches


def _special(
    shapes: Sequence[ShapeEntry], models: Sequence[Model], tree: Tree, *, h: float, report: Diagnostics
) -> frozenset[str]:
    """Names of the shapes that touch in a way of their own, and so need pairs however many there are."""
    odd = {shape.name for shape in shapes if not is_plain(shape.surface)}
    heaviest = max((tree.places[shape.link].link.inertial.mass for shape in shapes if not shape.fixed), default=0.0)

    def gives(shape: ShapeEntry) -> bool:
        mass = heaviest if shape.fixed else tree.places[shape.link].link.inertial.mass
        is_deep = shape.surface.min_depth > 0 and not shape.fixed
        return is_deep or (mass > 0 and is_soft(shape.surface.kp, 1 / mass, h))

    giving = [shape for shape in shapes if shape.name not in odd and gives(shape)]
    if len(giving) * len(shapes) <= MOST_GIVING_PAIRS:
        return frozenset(odd | {shape.name for shape in giving})
    first = giving[0]
    what = f"{len(giving)} of {len(shapes)} shapes give (kp, min_depth), from {first.collision!r} on"
    report.warn(models[first.model].at, f"{what}; so many are simulated hard")
    return frozenset(odd)


class _Rules:
    def __init__(self, models: Sequence[Model], tree: Tree) -> None:
        self._joined = {frozenset((hold.above, hold.below)) for hold in tree.joints}
        self._self_collides = {
            place.name: models[place.model].self_collide if place.link.self_collide is None else place.link.self_collide
            for place in tree.places.values()
        }

    def may_touch(self, a: ShapeEntry, b: ShapeEntry) -> bool:
        can = a.kind in b.meets and b.kind in a.meets
        return can and may_collide(a.surface, b.surface) and self.links_may_touch(a, b)

    def links_may_touch(self, a: ShapeEntry, b: ShapeEntry) -> bool:
        """Whether the links of two shapes may touch, whatever their bitmasks say."""
        if a.link == b.link or frozenset((a.link, b.link)) in self._joined:
            return False
        return a.model != b.model or (self._self_collides[a.link] and self._self_collides[b.link])


def _add_pairs(
    spec: mujoco.MjSpec,
    pairs: Iterable[tuple[ShapeEntry, ShapeEntry]],
    rules: _Rules,
    touches: dict[tuple[str, str], ContactParams],
) -> None:
    for a, b in pairs:
        if rules.may_touch(a, b):
            points = max(a.points, b.points)
            touch = touches[a.name, b.name] = contact_params_of(a.surface, b.surface, b_stands=b.fixed, points=points)
            _add_pair(spec, a, b, touch)


def _add_pair(spec: mujoco.MjSpec, a: ShapeEntry, b: ShapeEntry, touch: ContactParams) -> None:
    h = spec.option.timestep
    pair = spec.add_pair(name=pair_name(a.name, b.name), geomname1=a.name, geomname2=b.name)
    slides_freely = touch.mu <= 0 and touch.mu2 <= 0
    pair.condim = 1 if slides_freely else 4 if touch.torsion > 0 or touch.patch > 0 else 3
    # On a horizontal floor MuJoCo's first tangent lies along y, as ODE's does where no fdir1 is given.
    pair.friction = [max(touch.mu, 1e-5), max(touch.mu2, 1e-5), max(touch.torsion, 1e-5), 0.0001, 0.0001]
    pair.solref = limit_solref(h) if touch.min_depth > 0 else contact_solref(h)
    pair.solreffriction = sliding_solref(h)
    pair.solimp = SOLIMP
    pair.margin = _TOUCHING
    if not touch.is_felt:
        pair.margin, pair.gap = -_NEVER_FELT, _NEVER_FELT


def _let_find(
    fixed: Sequence[ShapeEntry], moving: Sequence[ShapeEntry], *, h: float, ranks: Mapping[float, int]
) -> None:
    """Let moving shapes find what stands; they do not find each other so."""
    for shape in fixed:
        _carry(shape, h, ranks)
        shape.geom.contype = shape.surface.collide_bitmask & _BITS
    for shape in moving:
        _carry(shape, h, ranks)
        shape.geom.conaffinity = shape.surface.collide_bitmask & _BITS


def _let_search(moving: Sequence[ShapeEntry], *, h: float, ranks: Mapping[float, int]) -> None:
    """Let moving shapes find each other."""
    for shape in moving:
        _carry(shape, h, ranks)
        shape.geom.contype = shape.surface.collide_bitmask & _BITS
        shape.geom.conaffinity = shape.surface.collide_bitmask & _BITS


def _carry(shape: ShapeEntry, h: float, ranks: Mapping[float, int]) -> None:
    """Write what contacts found by search need on the shape itself; the smaller friction has the higher priority."""
    mu, geom = friction_of(shape.surface), shape.geom
    geom.priority = ranks[mu]
    geom.friction = [mu, 0.005, 0.0001]
    geom.condim = 3 if mu > 0 else 1
    geom.solref = contact_solref(h)
    geom.solimp = SOLIMP


def _keep_apart(spec: mujoco.MjSpec, pairs: Iterable[tuple[ShapeEntry, ShapeEntry]], rules: _Rules) -> None:
    """Exclude links from the search that must not touch."""
    apart = {
        (min(a.link, b.link), max(a.link, b.link))
        for a, b in pairs
        if a.link != b.link and not rules.links_may_touch(a, b)
    }
    for one, other in sorted(apart):
        spec.add_exclude(bodyname1=one, bodyname2=other)

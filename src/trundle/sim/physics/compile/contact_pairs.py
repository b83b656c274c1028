"""Collision filtering and contact parameters: Gazebo's rules as MuJoCo contact pairs.

Gazebo uses the smaller friction of two surfaces, MuJoCo the larger, so each pair sets its own. Links connected by a
joint never collide, links of one model only with <self_collide>.

ODE and MuJoCo differ: ODE's friction pyramid becomes a cone where mu = mu2, and max_vel, which limits ODE's depth
correction, acts on soft contacts only (see `compliance`): at hard ones initial penetration is resolved at once (see
`separation`), impacts are corrected slowly.
"""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import combinations, product

import mujoco

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import Model

from .compliance import is_compliant, pair_name
from .contact_params import ContactParams, bitmasks_match, combine_surfaces, friction_of, frictions_of, is_plain
from .kinematic_tree import KinematicTree
from .shape_entry import CollidesWith, ShapeEntry
from .solver_settings import SOLIMP, contact_solref, limit_solref, sliding_solref
from .wheels import EDGE_POINTS

MAX_PAIRS = 2000
"""Maximum number of pairs of a fixed and a moving shape. With more, MuJoCo's broad phase finds the contacts: a pair
costs about 10 ns per step, in contact or not.
"""
MAX_MOVING_PAIRS = 1000
"""Maximum number of pairs of moving shapes; fewer, because these are rarely close to one another."""
MAX_SOFT_PAIRS = 20_000
"""Maximum number of pairs of soft shapes; with more, they are simulated as hard."""
_BITS = 0x7FFFFFFF
_TOUCHING = 1e-9
"""Margin of contacts [m]: a shape placed exactly on a floor is in contact from the first step on."""
_NO_FORCE_DEPTH = 1e3
"""Depth [m] larger than any penetration; contacts less deep than it are detected without a force."""


def add_contacts(
    spec: mujoco.MjSpec, shapes: Sequence[ShapeEntry], models: Sequence[Model], tree: KinematicTree, report: Diagnostics
) -> dict[tuple[str, str], ContactParams]:
    """Add a pair for every two shapes that may collide; return their parameters by shape names."""
    pair_params: dict[tuple[str, str], ContactParams] = {}
    for shape in shapes:
        shape.geom.contype = shape.geom.conaffinity = 0
    rules = _CollisionRules(models, tree)
    ranks = {mu: -i for i, mu in enumerate(sorted({friction_of(shape.surface) for shape in shapes}))}
    fixed = [shape for shape in shapes if shape.fixed]
    moving = [shape for shape in shapes if not shape.fixed]
    solid = [shape for shape in moving if shape.collides_with & CollidesWith.MOVING]
    special = _needs_pairs(spec, shapes, models, tree, report)
    if len(fixed) * len(moving) > MAX_PAIRS:
        # Planes, on which most bodies stand, keep their pairs: only a pair's solreffriction keeps sliding bodies from
        # hopping.
        searched = [shape for shape in fixed if shape.name not in special and shape.kind is CollidesWith.FIXED]
        searching = [
            shape for shape in moving if shape.name not in special and shape.collides_with & CollidesWith.FIXED
        ]
        _enable_search_of_fixed(searched, searching, h=spec.option.timestep, ranks=ranks)
        _exclude_pairs(spec, rules.near_pairs(searching, searched), rules)
        searching_names, searched_names = {shape.name for shape in searching}, {shape.name for shape in searched}
        paired = [shape for shape in fixed if shape.name not in searched_names]
        pairs = ((a, b) for a in moving for b in (paired if a.name in searching_names else fixed))
        _add_pairs(spec, pairs, rules, pair_params)
    else:
        _add_pairs(spec, product(moving, fixed), rules, pair_params)
    if len(solid) * (len(solid) - 1) <= 2 * MAX_MOVING_PAIRS:
        _add_pairs(spec, combinations(solid, 2), rules, pair_params)
        return pair_params
    plain = [shape for shape in solid if shape.name not in special]
    others = [shape for shape in solid if shape.name in special]
    _add_pairs(spec, product(others, plain), rules, pair_params)
    _add_pairs(spec, combinations(others, 2), rules, pair_params)
    _enable_search(plain, h=spec.option.timestep, ranks=ranks)
    for links in _links_of_models(plain).values():
        _exclude_pairs(spec, combinations(links.values(), 2), rules)
    return pair_params


def _needs_pairs(
    spec: mujoco.MjSpec,
    shapes: Sequence[ShapeEntry],
    models: Sequence[Model],
    tree: KinematicTree,
    report: Diagnostics,
) -> frozenset[str]:
    """Return the names of shapes that need explicit pairs, because of their surface or compliance."""
    h, gravity = spec.option.timestep, math.hypot(*spec.option.gravity)
    not_plain = {shape.name for shape in shapes if not is_plain(shape.surface)}
    heaviest = max((tree.links[shape.link].link.inertial.mass for shape in shapes if not shape.fixed), default=0.0)

    def has_soft_contacts(shape: ShapeEntry) -> bool:
        mass = heaviest if shape.fixed else tree.links[shape.link].link.inertial.mass
        has_min_depth = shape.surface.min_depth > 0 and not shape.fixed
        return has_min_depth or (mass > 0 and is_compliant(shape.surface, mass, h=h, gravity=gravity))

    soft = [shape for shape in shapes if shape.name not in not_plain and has_soft_contacts(shape)]
    if len(soft) * len(shapes) <= MAX_SOFT_PAIRS:
        return frozenset(not_plain | {shape.name for shape in soft})
    first = soft[0]
    problem = f"{len(soft)} of {len(shapes)} shapes are soft (kp, min_depth), the first {first.collision!r}"
    report.warn(models[first.model].at, f"{problem}; they are simulated as hard", "soft-contacts")
    return frozenset(not_plain)


class _CollisionRules:
    def __init__(self, models: Sequence[Model], tree: KinematicTree) -> None:
        self._neighbours: dict[str, set[str]] = {}
        """Links that are joined to a link."""
        for edge in tree.joints:
            self._neighbours.setdefault(edge.parent, set()).add(edge.child)
            self._neighbours.setdefault(edge.child, set()).add(edge.parent)
        self._self_collides = {
            node.name: models[node.model].self_collide if node.link.self_collide is None else node.link.self_collide
            for node in tree.links.values()
        }

    def can_collide(self, a: ShapeEntry, b: ShapeEntry) -> bool:
        can = a.kind in b.collides_with and b.kind in a.collides_with
        return can and bitmasks_match(a.surface, b.surface) and self.links_can_collide(a, b)

    def near_pairs(
        self, shapes: Iterable[ShapeEntry], others: Iterable[ShapeEntry]
    ) -> Iterator[tuple[ShapeEntry, ShapeEntry]]:
        """Yield the pairs of links of one model or joined by a joint, one shape a link; all other pairs can collide."""
        models = _links_of_models(others)
        by_link = {link: shape for links in models.values() for link, shape in links.items()}
        for links in _links_of_models(shapes).values():
            for a in links.values():
                yield from ((a, b) for b in models.get(a.model, {}).values())
                yield from ((a, by_link[link]) for link in self._neighbours.get(a.link, ()) if link in by_link)

    def links_can_collide(self, a: ShapeEntry, b: ShapeEntry) -> bool:
        """True if the links of two shapes may collide, regardless of bitmasks."""
        if a.link == b.link or b.link in self._neighbours.get(a.link, ()):
            return False
        return a.model != b.model or (self._self_collides[a.link] and self._self_collides[b.link])


def _links_of_models(shapes: Iterable[ShapeEntry]) -> dict[int, dict[str, ShapeEntry]]:
    """Return one shape of each link, by model and link."""
    models: dict[int, dict[str, ShapeEntry]] = {}
    for shape in shapes:
        models.setdefault(shape.model, {}).setdefault(shape.link, shape)
    return models


def _add_pairs(
    spec: mujoco.MjSpec,
    pairs: Iterable[tuple[ShapeEntry, ShapeEntry]],
    rules: _CollisionRules,
    pair_params: dict[tuple[str, str], ContactParams],
) -> None:
    for a, b in pairs:
        if rules.can_collide(a, b):
            points = EDGE_POINTS if a.has_tread and b.fixed else max(a.points, b.points)
            params = pair_params[a.name, b.name] = combine_surfaces(
                a.surface, b.surface, b_fixed=b.fixed, points=points
            )
            _add_pair(spec, a, b, params)


def _add_pair(spec: mujoco.MjSpec, a: ShapeEntry, b: ShapeEntry, params: ContactParams) -> None:
    h = spec.option.timestep
    pair = spec.add_pair(name=pair_name(a.name, b.name), geomname1=a.name, geomname2=b.name)
    pair.condim, pair.friction = pair_friction(params)
    pair.solref = limit_solref(h) if params.min_depth > 0 else contact_solref(h)
    pair.solreffriction = sliding_solref(h)
    pair.solimp = SOLIMP
    pair.margin = _TOUCHING
    if not params.has_force:
        pair.margin, pair.gap = -_NO_FORCE_DEPTH, _NO_FORCE_DEPTH


def pair_friction(params: ContactParams) -> tuple[int, list[float]]:
    """Return the dimension of a pair's contacts and its friction coefficients."""
    slides_freely = params.mu <= 0 and params.mu2 <= 0
    condim = 1 if slides_freely else 4 if params.torsion > 0 or params.patch > 0 else 3
    # MuJoCo's first tangent on a horizontal floor is y, as ODE's without fdir1.
    return condim, [max(params.mu, 1e-5), max(params.mu2, 1e-5), max(params.torsion, 1e-5), 0.0001, 0.0001]


def _enable_search_of_fixed(
    fixed: Sequence[ShapeEntry], moving: Sequence[ShapeEntry], *, h: float, ranks: Mapping[float, int]
) -> None:
    """Enable collision search between moving and fixed shapes, and not among the moving ones."""
    for shape in fixed:
        _set_geom_contact(shape, h, ranks)
        shape.geom.contype = shape.surface.collide_bitmask & _BITS
    for shape in moving:
        _set_geom_contact(shape, h, ranks)
        shape.geom.conaffinity = shape.surface.collide_bitmask & _BITS


def _enable_search(moving: Sequence[ShapeEntry], *, h: float, ranks: Mapping[float, int]) -> None:
    """Enable collision search among moving shapes."""
    for shape in moving:
        _set_geom_contact(shape, h, ranks)
        shape.geom.contype = shape.surface.collide_bitmask & _BITS
        shape.geom.conaffinity = shape.surface.collide_bitmask & _BITS


def _set_geom_contact(shape: ShapeEntry, h: float, ranks: Mapping[float, int]) -> None:
    """Set a geom's contact parameters for collision search; the smaller friction has the higher priority."""
    mu, geom = friction_of(shape.surface), shape.geom
    geom.priority = ranks[mu]
    geom.friction = [mu, 0.005, 0.0001]
    geom.condim = 3 if any(frictions_of(shape.surface)) else 1
    geom.solref = contact_solref(h)
    geom.solimp = SOLIMP


def _exclude_pairs(spec: mujoco.MjSpec, pairs: Iterable[tuple[ShapeEntry, ShapeEntry]], rules: _CollisionRules) -> None:
    """Exclude the body pairs that must not collide from the search."""
    excluded = {
        (min(a.link, b.link), max(a.link, b.link))
        for a, b in pairs
        if a.link != b.link and not rules.links_can_collide(a, b)
    }
    for first, second in sorted(excluded):
        spec.add_exclude(bodyname1=first, bodyname2=second)

"""Which shapes may touch, and how: Gazebo's rules written as MuJoCo contact pairs.

In Gazebo the smaller friction of two surfaces wins; MuJoCo takes the larger, so each pair states its own. Links
joined by a joint never touch, links of one model only where they say so.

ODE and MuJoCo cannot agree on everything: ODE's friction pyramid becomes an elliptic cone, and kp and kd, which act
per contact in ODE, become one stiffness per mass here.
"""

from collections.abc import Sequence
from itertools import combinations

import mujoco

from trundle.model import Model

from .settings import SOLIMP, contact_solref, sliding_solref
from .shapes import ShapeEntry

MOST_PAIRS = 2000
"""Beyond these, moving shapes meet by MuJoCo's own search: a pair costs about 10 ns a step whether it meets or not."""
INFINITE_FRICTION = 100.0
"""What SDF's negative mu stands for: steeper than any slope."""


def add_contacts(spec: mujoco.MjSpec, shapes: Sequence[ShapeEntry], models: Sequence[Model]) -> None:
    """Write a pair for every two shapes that may touch."""
    joined = [_joined(model) for model in models]
    meeting = [(a, b) for a, b in combinations(shapes, 2) if _may_touch(a, b, models, joined)]
    by_search = len(meeting) > MOST_PAIRS
    for shape in shapes:
        shape.geom.contype = shape.geom.conaffinity = 0
    for a, b in meeting:
        if by_search and not a.fixed and not b.fixed:
            continue
        _add_pair(spec, a, b)
    if by_search:
        _let_search(spec, shapes, models, joined)


def _may_touch(a: ShapeEntry, b: ShapeEntry, models: Sequence[Model], joined: list[set[frozenset[str]]]) -> bool:
    if a.fixed and b.fixed:
        return False
    if not a.surface.collide_bitmask & b.surface.collide_bitmask:
        return False
    if a.model != b.model:
        return True
    if a.link == b.link or frozenset((a.link, b.link)) in joined[a.model]:
        return False
    model = models[a.model]
    links = (model.link(a.link), model.link(b.link))
    return all(model.self_collide if link.self_collide is None else link.self_collide for link in links)


def _joined(model: Model) -> set[frozenset[str]]:
    return {frozenset((joint.parent, joint.child)) for joint in model.joints}


def _friction(mu: float) -> float:
    return INFINITE_FRICTION if mu < 0 else min(mu, INFINITE_FRICTION)


def _add_pair(spec: mujoco.MjSpec, a: ShapeEntry, b: ShapeEntry) -> None:
    h = spec.option.timestep
    mu = min(_friction(a.surface.mu), _friction(b.surface.mu))
    mu2 = min(_friction(a.surface.mu2), _friction(b.surface.mu2))
    pair = spec.add_pair(geomname1=a.name, geomname2=b.name)
    pair.condim = 3 if mu > 0 and mu2 > 0 else 1
    # MuJoCo's first tangent on a horizontal floor lies along y, ODE's second; so mu and mu2 change places.
    pair.friction = [max(mu, 1e-5), max(mu2, 1e-5), 0.005, 0.0001, 0.0001]
    pair.solref = contact_solref(h)
    pair.solreffriction = sliding_solref(h)
    pair.solimp = SOLIMP


def _let_search(
    spec: mujoco.MjSpec, shapes: Sequence[ShapeEntry], models: Sequence[Model], joined: list[set[frozenset[str]]]
) -> None:
    """Let moving shapes of different models find each other; the one with the smaller friction decides."""
    h = spec.option.timestep
    moving = [shape for shape in shapes if not shape.fixed]
    ranks = {mu: -i for i, mu in enumerate(sorted({_friction(s.surface.mu) for s in moving}))}
    for shape in moving:
        mu = _friction(shape.surface.mu)
        geom = shape.geom
        geom.contype = geom.conaffinity = 1
        geom.priority = ranks[mu]
        geom.friction = [mu, 0.005, 0.0001]
        geom.condim = 3 if mu > 0 else 1
        geom.solref = contact_solref(h)
        geom.solimp = SOLIMP
    for a, b in combinations(moving, 2):
        if a.model == b.model and a.link != b.link and not _may_touch(a, b, models, joined):
            _exclude(spec, models, a, b)


def _exclude(spec: mujoco.MjSpec, models: Sequence[Model], a: ShapeEntry, b: ShapeEntry) -> None:
    name = models[a.model].name
    first, second = f"{name}::{a.link}", f"{name}::{b.link}"
    if not any({e.bodyname1, e.bodyname2} == {first, second} for e in spec.excludes):
        spec.add_exclude(bodyname1=first, bodyname2=second)

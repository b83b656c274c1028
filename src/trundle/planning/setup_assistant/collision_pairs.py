"""Pairs of links that need no collision check, by MoveIt's reasons."""

from collections import Counter
from collections.abc import Iterable

import numpy as np

from trundle.base.diagnostics import Diagnostics, Source
from trundle.planning.planning_scene import AllowedCollisionMatrix, PlanningScene
from trundle.planning.robot_model import DisabledPair, RobotModel
from trundle.robots.packages import Packages

TRIALS = 10_000
"""Random states, as many as MoveIt's setup assistant takes by default."""
_ALWAYS = 0.95
"""Share of colliding states from which on a pair always collides, as in MoveIt."""
_FIRST = 200
"""Random states in which pairs that always collide are looked for, as in MoveIt."""
_MAX_CONTACTS = 100_000
_AT = Source("collisions")


def find_disabled_pairs(
    model: RobotModel, *, packages: Packages | None, report: Diagnostics, trials: int = TRIALS, seed: int = 0
) -> list[DisabledPair]:
    """Return pairs of links with shapes that need no check, and why.

    Adjacent: a joint is between them, perhaps with links without shapes. Default: they touch in the default state.
    Always: they touch in nearly all random states. Never: in none.
    """
    scene = PlanningScene(model, packages=packages, report=report)
    scene.allowed_collisions = AllowedCollisionMatrix()
    solid = [link.name for link in model.urdf.links if link.collisions]
    order = {name: i for i, name in enumerate(model.links)}
    solid.sort(key=lambda name: order[name])
    reasons: dict[tuple[str, str], str] = dict.fromkeys(_adjacent(model, set(solid)), "Adjacent")
    _allow(scene, reasons)
    for pair in _touching(scene, model.default_positions()):
        reasons.setdefault(pair, "Default")
    _allow(scene, reasons)
    rng = np.random.default_rng(seed)
    lower, upper = np.maximum(model.lower, -10.0), np.minimum(model.upper, 10.0)
    counts: Counter[tuple[str, str]] = Counter()
    first = min(_FIRST, trials)  # pairs that always touch are found first, and cost no further checks
    for trial in range(trials):
        counts.update(_touching(scene, model.with_mimics(rng.uniform(lower, upper))))
        if trial + 1 == first:
            always = [pair for pair, count in counts.items() if count >= _ALWAYS * first]
            reasons.update(dict.fromkeys(always, "Always"))
            _allow(scene, reasons)
    pairs = [(a, b) for i, a in enumerate(solid) for b in solid[i + 1 :]]
    for pair in pairs:
        if counts[pair] == 0:
            reasons.setdefault(pair, "Never")
    return [DisabledPair(link1=a, link2=b, reason=reasons[a, b], at=_AT) for a, b in sorted(pairs) if (a, b) in reasons]


def _touching(scene: PlanningScene, state: "np.ndarray[tuple[int], np.dtype[np.float64]]") -> set[tuple[str, str]]:
    order = {name: i for i, name in enumerate(scene.model.links)}
    contacts = scene.check(state, max_contacts=_MAX_CONTACTS)
    pairs = ((contact.body_1, contact.body_2) for contact in contacts)
    return {(a, b) if order[a] < order[b] else (b, a) for a, b in pairs}


def _allow(scene: PlanningScene, pairs: Iterable[tuple[str, str]]) -> None:
    scene.allowed_collisions = AllowedCollisionMatrix(frozenset(frozenset(pair) for pair in pairs))


def _adjacent(model: RobotModel, solid: set[str]) -> set[tuple[str, str]]:
    """Return pairs with a joint between them; links without shapes between two joints count as no link."""
    above: dict[str, str] = {}
    pairs: set[tuple[str, str]] = set()
    by_parent: dict[str, list[str]] = {}
    for joint in model.joints:
        parent = joint.parent_link
        holder = parent if parent in solid else above.get(parent, "")
        above[joint.child_link] = holder
        if joint.child_link in solid:
            if holder:
                pairs.add((holder, joint.child_link))
            elif parent:
                by_parent.setdefault(parent, []).append(joint.child_link)
    return pairs

"""Recorded motion of a world, and its animated scene."""

from collections.abc import Callable

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import AnimationState, World
from trundle.sim.gltf import animated_glb
from trundle.sim.render import DEFAULT_LIGHTS, report_unreadable_textures, scene_from_world
from trundle.sim.simulation import Simulation, StateLog
from trundle.spatial import NS_PER_S

from ..actor_bones import ActorBones

_Array = NDArray[np.float64]


class RecordedMotion(Struct, frozen=True, eq=False, kw_only=True):
    """Poses of all bodies of a world over time."""

    title: str
    world: World
    """Flat, with its actors."""
    times: _Array
    """(N,) ascending [s]"""
    poses: _Array
    """(N, bodies, 7) x y z [m], qw qx qy qz in the world; first the links, then the actors' bones."""


def motion_of_log(log: StateLog, simulation: Simulation, title: str) -> RecordedMotion:
    """Return the motion in a state log; actors move by their scripts.

    Args:
        log: state log with at least one row.
        simulation: simulation of the log's world.
        title: recording's title.
    """
    bones = ActorBones(simulation.world)

    def states_at(time_s: float) -> Callable[[str], AnimationState]:
        time_ns = round(time_s * NS_PER_S)
        return lambda actor: simulation.actors[actor].animation_state(time_ns)

    rows = [bones.with_bones(row, states_at(time)) for time, row in zip(log.times_s.tolist(), log.poses, strict=True)]
    return RecordedMotion(title=title, world=simulation.world, times=log.times_s, poses=np.stack(rows))


def animated_world(motion: RecordedMotion, report: Diagnostics) -> bytes:
    """Return recorded motion as an animated GLB; a world without lights gets the default lights of cameras."""
    scene = scene_from_world(motion.world, report)
    scene = replace(scene, lights=scene.lights or DEFAULT_LIGHTS)
    report_unreadable_textures(scene, report)
    return animated_glb(scene, motion.times, motion.poses)

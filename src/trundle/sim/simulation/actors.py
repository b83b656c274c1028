"""Actors as kinematic bodies that follow their scripts.

An actor without a usable skeleton is a box of its skin's size; the others are drawn with animated skins.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import Box, Link, Model, Visual, World
from trundle.spatial import Pose, Vector3

from .handles import ModelHandle

if TYPE_CHECKING:  # worlds without actors do not import their modules
    from trundle.robots.model import Actor, AnimationState, Skin

    from .runtime import Runtime

_PERSON: Vector3 = (0.3, 0.5, 1.8)
"""Size of a skin that cannot be read [m]."""
_ACTOR_PLUGIN = "libActorPlugin.so"
"""Plugin that ignores scripts, and turns skins, whose up axis is y, upright with the hips at 1.2138 m."""
_HIPS = 1.2138
_WALKING = "walking"
"""Animation that the plugin plays."""


def with_actors(world: World, report: Diagnostics) -> World:
    """Return the world with an added model for each visible actor that has none."""
    names = {model.name for model in world.models}
    added = [_model(actor, report) for actor in world.actors if actor.name not in names]
    return replace(world, models=(*world.models, *(model for model in added if model.links)))


class ActorPlayer:
    """Hook that moves an actor along its script; between two calls it has a constant twist."""

    period_ns = 20_000_000

    def __init__(self, actor: "Actor", handle: ModelHandle) -> None:
        from .actor_script import ActorScript

        self._script = ActorScript(actor)
        self._handle = handle
        self.is_on = bool(self._script) and actor.auto_start
        self._starts = actor.auto_start
        self.taken_over = False
        self.animation_s = 0.0
        """Animation time of an actor that a plugin moves [s]."""

    def stop(self) -> None:
        """Stop the script and leave pose and animation to a plugin."""
        self.is_on, self.taken_over = False, True

    def animation_state(self, time_ns: int) -> "AnimationState":
        """Return the actor's animation state."""
        from trundle.robots.model import AnimationState

        if self.taken_over:
            return AnimationState(animation=_WALKING, time_s=self.animation_s, distance_m=0.0, placed=False)
        return self._script.animation_state_at(time_ns / 1e9 if self._starts else 0.0)

    def enabled(self, models: Sequence[ModelHandle]) -> bool:
        """True if the actor exists and its script runs."""
        return self.is_on and any(model is self._handle for model in models)

    def before_step(self, sim: "Runtime") -> None:
        """Set the actor's pose and twist."""
        time_s, dt = sim.time_ns / 1e9, self.period_ns / 1e9
        self._handle.set_pose(self._script.pose_at(time_s))
        self._handle.set_twist(self._script.twist_at(time_s, dt))


def _model(actor: "Actor", report: Diagnostics) -> Model:
    from .actor_script import ActorScript

    links = [replace(link, kinematic=True, gravity=False) for link in actor.links]
    if actor.skin is not None:
        links.insert(0, _body(actor, actor.skin, report))
    script = ActorScript(actor)
    starts = bool(script) and actor.auto_start and not _has_actor_plugin(actor)
    return Model(
        name=actor.name,
        at=actor.at,
        world_from_model=script.pose_at(0.0) if starts else actor.world_from_actor,
        links=tuple(links),
        joints=actor.joints,
        plugins=actor.plugins,
        canonical_link=links[0].name if links else None,
    )


def _body(actor: "Actor", skin: "Skin", report: Diagnostics) -> Link:
    width, depth, height = _size(skin)
    link_from_visual = Pose((0.0, 0.0, height / 2))
    if _has_actor_plugin(actor):
        link_from_visual = Pose.from_rpy(0.0, height / 2 - _HIPS, 0.0, -1.5707963)
    name = f"{actor.name}_pose"
    visual = Visual(name=name, at=actor.at, geometry=Box((width, depth, height)), link_from_visual=link_from_visual)
    from trundle.sim.render import unsupported_reason

    reason = unsupported_reason(actor)
    if reason is not None:
        report.info(
            actor.at, f"actor {actor.name!r} is a box of its skin's size; its bones do not move: {reason}", "actor-skin"
        )
    return Link(name=name, at=actor.at, kinematic=True, gravity=False, visuals=(visual,))


def _has_actor_plugin(actor: "Actor") -> bool:
    return any(tag.filename.endswith(_ACTOR_PLUGIN) for tag in actor.plugins)


def _size(skin: "Skin") -> Vector3:
    """Return the size of the box [m], the largest side upwards."""
    if skin.path is None:
        return _PERSON
    from trundle.robots.meshes import MeshError, load_mesh

    try:
        vertices = load_mesh(skin.path).vertices
    except MeshError:
        return _PERSON
    x, y, z = sorted(((vertices.max(axis=0) - vertices.min(axis=0)) * skin.scale).tolist())
    return (max(x, 0.01), max(y, 0.01), max(z, 0.01))

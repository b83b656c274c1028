"""Actors: scripted, animated bodies that no force moves."""

from pathlib import Path

from msgspec import Struct

from trundle.base.diagnostics import Source
from trundle.spatial import Pose

from .joint import Joint
from .link import Link
from .plugin import PluginTag


class Skin(Struct, frozen=True, kw_only=True):
    """Skinned mesh."""

    path: Path | None
    """None if the file was not found; the reader warned."""
    uri: str
    scale: float = 1.0


class Animation(Struct, frozen=True, kw_only=True):
    """Skeleton animation, played in a loop."""

    name: str
    path: Path | None
    """.dae or .bvh; None if the file was not found; the reader warned."""
    uri: str
    scale: float = 1.0
    interpolate_x: bool = False
    """True if the animation advances with the distance covered along x, not with time."""


class Waypoint(Struct, frozen=True, kw_only=True):
    """Pose of an actor at a time of its trajectory."""

    time_s: float
    """Time since the start of the trajectory."""
    pose: Pose
    """Pose in the world frame, as in Gazebo, whatever the actor's own pose."""


class Trajectory(Struct, frozen=True, kw_only=True):
    """Spline through timed waypoints."""

    id: int
    type: str
    """Name of the animation played along the trajectory."""
    tension: float = 0.0
    """0: a Catmull-Rom spline; 1: straight lines."""
    waypoints: tuple[Waypoint, ...] = ()
    """Sorted by time."""


class AnimationState(Struct, frozen=True, kw_only=True):
    """Playback state of an actor's skeleton animation."""

    animation: str = ""
    """Name of the animation; an unknown name selects the first."""
    time_s: float = 0.0
    """Time since the animation began."""
    distance_m: float | None = None
    """Distance covered along the trajectory; None: the actor does not move, but the animation moves the root bone."""
    placed: bool = True
    """True if the animation also places the root bone; False: the actor's pose does."""


class Actor(Struct, frozen=True, kw_only=True):
    """Scripted body: moved by its trajectories or by plugins, never by physics."""

    name: str
    at: Source
    world_from_actor: Pose = Pose()
    skin: Skin | None = None
    """None: only the visuals of its links are drawn."""
    animations: tuple[Animation, ...] = ()
    loop: bool = True
    """Start over when all trajectories are done."""
    delay_start_s: float = 0.0
    """Delay before each round."""
    auto_start: bool = True
    """Start with the world."""
    trajectories: tuple[Trajectory, ...] = ()
    """Sorted by id."""
    links: tuple[Link, ...] = ()
    joints: tuple[Joint, ...] = ()
    plugins: tuple[PluginTag, ...] = ()

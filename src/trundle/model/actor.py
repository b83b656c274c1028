"""People and things that walk through a world by a script; nothing pushes them."""

from pathlib import Path

from msgspec import Struct

from trundle.diagnostics import Source
from trundle.spatial import Pose

from .joint import Joint
from .link import Link
from .plugin import PluginTag


class Skin(Struct, frozen=True, kw_only=True):
    """A mesh with bones in it."""

    path: Path | None
    """None: nowhere, which was said."""
    uri: str
    scale: float = 1.0


class Animation(Struct, frozen=True, kw_only=True):
    """How the bones move, over and over."""

    name: str
    path: Path | None
    """.dae or .bvh; None: nowhere, which was said."""
    uri: str
    scale: float = 1.0
    interpolate_x: bool = False
    """Whether it goes on with the way that is covered, not with time."""


class Waypoint(Struct, frozen=True, kw_only=True):
    """Where an actor is at a time of its trajectory."""

    time_s: float
    """From the trajectory's start."""
    pose: Pose
    """In the world, as Gazebo has it, wherever the actor is put."""


class Trajectory(Struct, frozen=True, kw_only=True):
    """A smooth way through waypoints."""

    id: int
    type: str
    """The name of the animation that plays meanwhile."""
    tension: float = 0.0
    """0: a Catmull-Rom spline; 1: straight lines."""
    waypoints: tuple[Waypoint, ...] = ()
    """By time."""


class AnimationState(Struct, frozen=True, kw_only=True):
    """What the bones of an actor are at."""

    animation: str = ""
    """Its name; what no animation bears stands for the first."""
    time_s: float = 0.0
    """Since the animation began."""
    distance_m: float | None = None
    """What has been covered of the way; None: the actor stands, and the animation itself carries it along."""
    placed: bool = True
    """Whether the animation places and turns the root bone, too; else the actor's own pose does."""


class Actor(Struct, frozen=True, kw_only=True):
    """Something that moves as its script or its plugins say."""

    name: str
    at: Source
    world_from_actor: Pose = Pose()
    skin: Skin | None = None
    """None: what is seen is on its links."""
    animations: tuple[Animation, ...] = ()
    loop: bool = True
    """Begin again when all trajectories are done."""
    delay_start_s: float = 0.0
    """Wait before each round."""
    auto_start: bool = True
    """Move as soon as the world does."""
    trajectories: tuple[Trajectory, ...] = ()
    """By their numbers."""
    links: tuple[Link, ...] = ()
    joints: tuple[Joint, ...] = ()
    plugins: tuple[PluginTag, ...] = ()

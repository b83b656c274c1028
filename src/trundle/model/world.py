"""Models and the world that holds them: what every reader makes and every consumer starts from."""

from dataclasses import dataclass

from trundle.diagnostics import Source
from trundle.spatial import Pose, Vector3

from .joint import Joint
from .link import Link
from .material import Rgba
from .plugin import PluginTag


@dataclass(frozen=True, slots=True, kw_only=True)
class Model:
    """Links joined by joints, placed as one."""

    name: str
    at: Source
    world_from_model: Pose = Pose()
    static: bool = False
    self_collide: bool = False
    links: tuple[Link, ...] = ()
    joints: tuple[Joint, ...] = ()
    plugins: tuple[PluginTag, ...] = ()
    canonical_link: str | None = None
    """The link the model's pose follows; None: the first."""
    added: bool = False
    """Put there by `run`, not named by the file."""

    def link(self, name: str) -> Link:
        """The link of that name.

        Raises:
            KeyError: with the names there are.
        """
        for link in self.links:
            if link.name == name:
                return link
        raise KeyError(f"model {self.name!r} has no link {name!r}; links here: {_quoted(self.links)}")

    def joint(self, name: str) -> Joint:
        """The joint of that name.

        Raises:
            KeyError: with the names there are.
        """
        for joint in self.joints:
            if joint.name == name:
                return joint
        raise KeyError(f"model {self.name!r} has no joint {name!r}; joints here: {_quoted(self.joints)}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Light:
    """A source of light."""

    name: str
    type: str
    """directional, point or spot."""
    at: Source
    world_from_light: Pose = Pose()
    direction: Vector3 = (0.0, 0.0, -1.0)
    """Unit, in the light's frame."""
    diffuse: Rgba = (1.0, 1.0, 1.0, 1.0)
    specular: Rgba = (0.1, 0.1, 0.1, 1.0)
    cast_shadows: bool = False
    added: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class PhysicsSettings:
    """How time passes and what pulls."""

    max_step_size_s: float = 0.001
    real_time_update_rate_hz: float = 1000.0
    """Steps per second of wall time that Gazebo aims at; 0: as fast as possible."""
    gravity: Vector3 = (0.0, 0.0, -9.8)
    """[m/s²] SDF's default, not 9.81."""


@dataclass(frozen=True, slots=True, kw_only=True)
class World:
    """Everything that is simulated together."""

    name: str
    at: Source
    models: tuple[Model, ...] = ()
    lights: tuple[Light, ...] = ()
    plugins: tuple[PluginTag, ...] = ()
    physics: PhysicsSettings = PhysicsSettings()
    background: Rgba = (0.7, 0.7, 0.7, 1.0)
    """Sky colour; Gazebo's grey."""
    sdf_version: str | None = None
    """As written in the file; None for a URDF."""


def _quoted(named: tuple[Link, ...] | tuple[Joint, ...]) -> str:
    return ", ".join(repr(n.name) for n in named) or "none"

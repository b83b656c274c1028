"""Manifest of a simulated world: what the page's client knows of it, but for what moves."""

from typing import TypeAlias

from msgspec import Struct

from .draft_info import DraftInfo, FileUrl

Triple: TypeAlias = tuple[float, float, float]
SixNumbers: TypeAlias = tuple[float, float, float, float, float, float]
"""Pose as x y z [m], roll pitch yaw [rad]."""


class Fog(Struct, frozen=True, kw_only=True):
    """Fog, with SDF's meaning."""

    type: str
    color: Triple
    start: float
    """[m]"""
    end: float
    """[m]"""
    density: float


class SceneSettings(Struct, frozen=True, kw_only=True):
    """Light, background, sky and fog of a world; colors 0 to 1."""

    ambient: Triple
    background: Triple
    sky: bool
    shadows: bool
    grid: bool
    fog: Fog | None


class PhysicsSettings(Struct, frozen=True, kw_only=True):
    """Settings of the physics that can be edited."""

    gravity: Triple
    """[m/s²]"""
    wind: Triple
    """[m/s]"""
    step: float
    """Time step [s]."""


class PluginInfo(Struct, frozen=True, kw_only=True):
    """A plugin, as it was written."""

    name: str
    """The second of one name has a number behind it."""
    filename: str
    source: str | None
    """`file:line`"""
    parameters: tuple[tuple[str, str], ...]
    """Path below its element (`noise/stddev`) and text."""


class SensorInfo(Struct, frozen=True, kw_only=True):
    """A sensor of a link, or of the joint above it."""

    name: str
    type: str
    rate: float
    """[Hz]"""
    topic: str | None
    series: tuple[str, ...]
    """Values of its readings that can be plotted: `angular_velocity.z`."""
    source: str | None
    """`file:line`"""
    plugins: tuple[PluginInfo, ...]


class LinkInfo(Struct, frozen=True, kw_only=True):
    """A link."""

    name: str
    body: int
    """Number among the poses."""
    mass: float
    """[kg]"""
    inertia: SixNumbers
    """ixx iyy izz ixy ixz iyz [kg·m²]."""
    inertial_pose: SixNumbers
    friction: tuple[float, float] | None
    """mu and mu2; None: it has no collision."""
    source: str | None
    """`file:line`"""
    sensors: tuple[SensorInfo, ...]


class JointInfo(Struct, frozen=True, kw_only=True):
    """A joint."""

    name: str
    type: str
    parent: str
    child: str
    lower: float | None
    """[rad or m]; None: no limit."""
    upper: float | None
    """[rad or m]; None: no limit."""
    pose: SixNumbers
    """Frame of the joint in the child's."""
    axes: tuple[Triple, ...]
    """Directions in the child's frame."""
    index: int | None
    """Row in `trundle/joints`; None: it has no single axis."""
    source: str | None
    """`file:line`"""


class ModelInfo(Struct, frozen=True, kw_only=True):
    """A model, with those nested in it."""

    name: str
    static: bool
    held: bool = False
    """True if its base is fixed where it is, until it is freed."""
    source: str | None
    """`file:line`"""
    links: tuple[LinkInfo, ...] = ()
    joints: tuple[JointInfo, ...] = ()
    plugins: tuple[PluginInfo, ...] = ()
    models: "tuple[ModelInfo, ...]" = ()


class LightInfo(Struct, frozen=True, kw_only=True):
    """A light of the world itself, or `model::link::name` of one on a link."""

    name: str
    type: str
    body: int | None
    """Body in whose frame its pose is; None: the world's."""
    pose: SixNumbers
    direction: Triple
    """Direction of the light in its own frame."""
    diffuse: Triple
    """Color, 0 to 1."""
    intensity: float


class CameraInfo(Struct, frozen=True, kw_only=True):
    """A camera."""

    name: str
    topic: str
    body: int
    """Body in whose frame its pose is."""
    pose: SixNumbers
    horizontal_fov: float
    """[rad]"""
    width: int
    """[px]"""
    height: int
    """[px]"""
    near: float
    """Nearest that it draws [m]."""
    far: float
    """Farthest that it draws [m]."""
    rate: float
    """[Hz]"""


class FrameInfo(Struct, frozen=True, kw_only=True):
    """A frame of tf that moves with a body."""

    frame: str
    parent: str
    body: int


class Manifest(Struct, frozen=True, kw_only=True):
    """Simulated world; generation, file, files and draft are set as it is shown."""

    generation: int = 0
    """Number that poses, joints and contacts of this world repeat."""
    name: str
    file: str | None = None
    """Path to save the world at; None: it cannot be written."""
    files: tuple[FileUrl, ...] = ()
    """In the order in which the models came."""
    collisions: str | None = None
    """URL of a GLB."""
    resources: tuple[str, ...] = ()
    """URLs of the meshes and images that these files name."""
    scene: SceneSettings
    physics: PhysicsSettings
    robot: int | None = None
    """Body that is framed first."""
    models: tuple[ModelInfo, ...] = ()
    plugins: tuple[PluginInfo, ...] = ()
    """Plugins of the world itself."""
    lights: tuple[LightInfo, ...] = ()
    cameras: tuple[CameraInfo, ...] = ()
    frames: tuple[FrameInfo, ...] = ()
    draft: DraftInfo | None = None
    """Copy of a model that is edited, in whose place it is shown."""

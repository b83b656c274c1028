"""Manifest of a simulated world: everything that the page's client shows, except motion."""

from typing import TypeAlias

from msgspec import Struct

from .draft_info import DraftInfo, FileUrl
from .reference import ReferenceInfo

Triple: TypeAlias = tuple[float, float, float]
PoseNumbers: TypeAlias = tuple[float, float, float, float, float, float]
"""Pose as x y z [m], roll pitch yaw [rad]."""
InertiaNumbers: TypeAlias = tuple[float, float, float, float, float, float]
"""ixx iyy izz ixy ixz iyz [kg·m²]."""


class Fog(Struct, frozen=True, kw_only=True):
    """Fog, as in SDF."""

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
    """Editable settings of the physics."""

    gravity: Triple
    """[m/s²]"""
    wind: Triple
    """[m/s]"""
    step: float
    """Time step [s]."""


class PluginInfo(Struct, frozen=True, kw_only=True):
    """Plugin, as in its file."""

    name: str
    """Name, with a number for the second plugin of the same name."""
    filename: str
    source: str | None
    """`file:line`"""
    parameters: tuple[tuple[str, str], ...]
    """Path in the plugin's element (`noise/stddev`) and text."""


class SensorInfo(Struct, frozen=True, kw_only=True):
    """Sensor of a link, or of its parent joint."""

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
    """Link."""

    name: str
    body: int
    """Body number: row in `trundle/poses`."""
    mass: float
    """[kg]"""
    inertia: InertiaNumbers
    inertial_pose: PoseNumbers
    friction: tuple[float, float] | None
    """mu and mu2; None: no collisions."""
    source: str | None
    """`file:line`"""
    sensors: tuple[SensorInfo, ...]


class JointInfo(Struct, frozen=True, kw_only=True):
    """Joint."""

    name: str
    type: str
    parent: str
    child: str
    lower: float | None
    """[rad or m]; None: no limit."""
    upper: float | None
    """[rad or m]; None: no limit."""
    pose: PoseNumbers
    """Pose of the joint's frame in the child's."""
    axes: tuple[Triple, ...]
    """Directions in the child's frame."""
    index: int | None
    """Row in `trundle/joints`; None: no single axis."""
    source: str | None
    """`file:line`"""


class ModelInfo(Struct, frozen=True, kw_only=True):
    """Model, with nested models."""

    name: str
    static: bool
    held: bool = False
    """True if the model is held: its base is fixed to the world."""
    source: str | None
    """`file:line`"""
    links: tuple[LinkInfo, ...] = ()
    joints: tuple[JointInfo, ...] = ()
    plugins: tuple[PluginInfo, ...] = ()
    models: "tuple[ModelInfo, ...]" = ()


class LightInfo(Struct, frozen=True, kw_only=True):
    """Light of the world, or of a link (then named `model::link::light`)."""

    name: str
    type: str
    body: int | None
    """Body in whose frame the pose is; None: the world frame."""
    pose: PoseNumbers
    direction: Triple
    """Direction in the light's frame."""
    diffuse: Triple
    """Color, 0 to 1."""
    intensity: float


class CameraInfo(Struct, frozen=True, kw_only=True):
    """Camera."""

    name: str
    topic: str
    body: int
    """Body in whose frame the pose is."""
    pose: PoseNumbers
    horizontal_fov: float
    """[rad]"""
    width: int
    """[px]"""
    height: int
    """[px]"""
    near: float
    """Near clipping distance [m]."""
    far: float
    """Far clipping distance [m]."""
    rate: float
    """[Hz]"""


class FrameInfo(Struct, frozen=True, kw_only=True):
    """tf frame that moves with a body."""

    frame: str
    parent: str
    body: int


class Manifest(Struct, frozen=True, kw_only=True):
    """Simulated world; generation, file, files, draft and reference are set later."""

    generation: int = 0
    """Number that is also in the headers of this world's poses, joints and contacts."""
    name: str
    file: str | None = None
    """Path to offer for saving the world; None: not writable."""
    files: tuple[FileUrl, ...] = ()
    """Files of the lights and of the models, in the order of the models."""
    collisions: str | None = None
    """URL of a GLB."""
    resources: tuple[str, ...] = ()
    """URLs of the meshes and images that these files refer to."""
    scene: SceneSettings
    physics: PhysicsSettings
    robot: int | None = None
    """Body number of the robot, on which the view centres first."""
    models: tuple[ModelInfo, ...] = ()
    plugins: tuple[PluginInfo, ...] = ()
    """Plugins of the world itself."""
    lights: tuple[LightInfo, ...] = ()
    cameras: tuple[CameraInfo, ...] = ()
    frames: tuple[FrameInfo, ...] = ()
    draft: DraftInfo | None = None
    """Copy of a model that is being edited, shown in place of the original."""
    reference: ReferenceInfo | None = None
    """Recording that the world is compared with."""

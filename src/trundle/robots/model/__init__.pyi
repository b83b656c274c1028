from .actor import (
    Actor as Actor,
    Animation as Animation,
    AnimationState as AnimationState,
    Skin as Skin,
    Trajectory as Trajectory,
    Waypoint as Waypoint,
)
from .camera import (
    CameraOptics as CameraOptics,
    Distortion as Distortion,
    Lens as Lens,
    PixelIntrinsics as PixelIntrinsics,
    Projection as Projection,
)
from .environment import (
    Atmosphere as Atmosphere,
    Fog as Fog,
    PhysicsSettings as PhysicsSettings,
    SceneSettings as SceneSettings,
    SphericalCoordinates as SphericalCoordinates,
)
from .flatten import flattened as flattened
from .geometry import (
    Box as Box,
    Capsule as Capsule,
    Cone as Cone,
    Cylinder as Cylinder,
    Ellipsoid as Ellipsoid,
    Empty as Empty,
    Geometry as Geometry,
    Heightmap as Heightmap,
    MeshFile as MeshFile,
    Plane as Plane,
    Polyline as Polyline,
    Solid as Solid,
    Sphere as Sphere,
    TerrainLayer as TerrainLayer,
)
from .inertial import Inertial as Inertial
from .instrument import (
    AirPressure as AirPressure,
    AirSpeed as AirSpeed,
    Altimeter as Altimeter,
    Instrument as Instrument,
    LogicalCamera as LogicalCamera,
    Magnetometer as Magnetometer,
    Sonar as Sonar,
    Transceiver as Transceiver,
)
from .joint import (
    UNLIMITED as UNLIMITED,
    Joint as Joint,
    JointAxis as JointAxis,
    JointType as JointType,
    Mimic as Mimic,
)
from .kinematic_model import Frame as Frame, Model as Model
from .kinematics import model_from_joint as model_from_joint, model_from_links as model_from_links
from .light import Light as Light, LightType as LightType
from .link import Collision as Collision, Link as Link, Visual as Visual
from .material import GREY as GREY, Material as Material, Rgba as Rgba
from .measuring import (
    ForceTorque as ForceTorque,
    GpsNoise as GpsNoise,
    ImuNoise as ImuNoise,
    OrientationReference as OrientationReference,
    RangeScan as RangeScan,
    ScanAxis as ScanAxis,
)
from .noise import Noise as Noise
from .plugin import PluginTag as PluginTag
from .road import Road as Road
from .sensor import MEASURING as MEASURING, Sensor as Sensor
from .surface import Surface as Surface
from .texture_colors import TEXTURE_COLORS as TEXTURE_COLORS, with_plain_color as with_plain_color
from .visibility import EVERY_BIT as EVERY_BIT
from .world import World as World

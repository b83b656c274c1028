"""World, Model, Link, Joint, …: frozen dataclasses with SDF's meaning, the narrow waist of Trundle."""

from .actor import Actor, Animation, Skin, Trajectory, Waypoint
from .camera import CameraOptics, Distortion, Lens, PixelIntrinsics, Projection
from .environment import Atmosphere, Fog, Light, LightType, PhysicsSettings, SceneSettings, SphericalCoordinates
from .flatten import flattened
from .geometry import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Empty,
    Geometry,
    Heightmap,
    MeshFile,
    Plane,
    Polyline,
    Solid,
    Sphere,
    TerrainLayer,
)
from .inertial import Inertial
from .instrument import AirPressure, AirSpeed, Altimeter, Instrument, LogicalCamera, Magnetometer, Sonar, Transceiver
from .joint import UNLIMITED, Joint, JointAxis, JointType, Mimic
from .kinematics import model_from_joint, model_from_links
from .link import Collision, Link, Visual
from .material import GREY, Material, Rgba
from .model import Frame, Model
from .noise import Noise
from .plugin import PluginTag
from .road import Road
from .sensor import ForceTorque, GpsNoise, ImuNoise, OrientationReference, RangeScan, ScanAxis, Sensor
from .surface import Surface
from .world import World

__all__ = [
    "GREY",
    "UNLIMITED",
    "Actor",
    "AirPressure",
    "AirSpeed",
    "Altimeter",
    "Animation",
    "Atmosphere",
    "Box",
    "CameraOptics",
    "Capsule",
    "Collision",
    "Cone",
    "Cylinder",
    "Distortion",
    "Ellipsoid",
    "Empty",
    "Fog",
    "ForceTorque",
    "Frame",
    "Geometry",
    "GpsNoise",
    "Heightmap",
    "ImuNoise",
    "Inertial",
    "Instrument",
    "Joint",
    "JointAxis",
    "JointType",
    "Lens",
    "Light",
    "LightType",
    "Link",
    "LogicalCamera",
    "Magnetometer",
    "Material",
    "MeshFile",
    "Mimic",
    "Model",
    "Noise",
    "OrientationReference",
    "PhysicsSettings",
    "PixelIntrinsics",
    "Plane",
    "PluginTag",
    "Polyline",
    "Projection",
    "RangeScan",
    "Rgba",
    "Road",
    "ScanAxis",
    "SceneSettings",
    "Sensor",
    "Skin",
    "Solid",
    "Sonar",
    "Sphere",
    "SphericalCoordinates",
    "Surface",
    "TerrainLayer",
    "Trajectory",
    "Transceiver",
    "Visual",
    "Waypoint",
    "World",
    "flattened",
    "model_from_joint",
    "model_from_links",
]

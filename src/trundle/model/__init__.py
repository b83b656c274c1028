"""World, Model, Link, Joint, …: frozen structs with SDF's meaning, the narrow waist of Trundle.

Names are imported on first use: a robot of boxes loads no cameras.
"""

from typing import TYPE_CHECKING

from trundle.doors import opened_on_use

if TYPE_CHECKING:
    from .actor import Actor, Animation, Moment, Skin, Trajectory, Waypoint
    from .camera import CameraOptics, Distortion, Lens, PixelIntrinsics, Projection
    from .environment import Atmosphere, Fog, PhysicsSettings, SceneSettings, SphericalCoordinates
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
    from .instrument import (
        AirPressure,
        AirSpeed,
        Altimeter,
        Instrument,
        LogicalCamera,
        Magnetometer,
        Sonar,
        Transceiver,
    )
    from .joint import UNLIMITED, Joint, JointAxis, JointType, Mimic
    from .kinematics import model_from_joint, model_from_links
    from .light import Light, LightType
    from .link import Collision, Link, Visual
    from .material import GREY, Material, Rgba
    from .measuring import ForceTorque, GpsNoise, ImuNoise, OrientationReference, RangeScan, ScanAxis
    from .model import Frame, Model
    from .noise import Noise
    from .plugin import PluginTag
    from .road import Road
    from .sensor import MEASURING, Sensor
    from .surface import Surface
    from .visibility import EVERY_BIT
    from .world import World

_HOMES = {
    "Actor": "actor",
    "AirPressure": "instrument",
    "AirSpeed": "instrument",
    "Altimeter": "instrument",
    "Animation": "actor",
    "Atmosphere": "environment",
    "Box": "geometry",
    "CameraOptics": "camera",
    "Capsule": "geometry",
    "Collision": "link",
    "Cone": "geometry",
    "Cylinder": "geometry",
    "Distortion": "camera",
    "EVERY_BIT": "visibility",
    "Ellipsoid": "geometry",
    "Empty": "geometry",
    "Fog": "environment",
    "ForceTorque": "measuring",
    "Frame": "model",
    "GREY": "material",
    "Geometry": "geometry",
    "GpsNoise": "measuring",
    "Heightmap": "geometry",
    "ImuNoise": "measuring",
    "Inertial": "inertial",
    "Instrument": "instrument",
    "Joint": "joint",
    "JointAxis": "joint",
    "JointType": "joint",
    "Lens": "camera",
    "Light": "light",
    "LightType": "light",
    "Link": "link",
    "LogicalCamera": "instrument",
    "MEASURING": "sensor",
    "Magnetometer": "instrument",
    "Material": "material",
    "MeshFile": "geometry",
    "Mimic": "joint",
    "Model": "model",
    "Moment": "actor",
    "Noise": "noise",
    "OrientationReference": "measuring",
    "PhysicsSettings": "environment",
    "PixelIntrinsics": "camera",
    "Plane": "geometry",
    "PluginTag": "plugin",
    "Polyline": "geometry",
    "Projection": "camera",
    "RangeScan": "measuring",
    "Rgba": "material",
    "Road": "road",
    "ScanAxis": "measuring",
    "SceneSettings": "environment",
    "Sensor": "sensor",
    "Skin": "actor",
    "Solid": "geometry",
    "Sonar": "instrument",
    "Sphere": "geometry",
    "SphericalCoordinates": "environment",
    "Surface": "surface",
    "TerrainLayer": "geometry",
    "Trajectory": "actor",
    "Transceiver": "instrument",
    "UNLIMITED": "joint",
    "Visual": "link",
    "Waypoint": "actor",
    "World": "world",
    "flattened": "flatten",
    "model_from_joint": "kinematics",
    "model_from_links": "kinematics",
}
__getattr__ = opened_on_use(__name__, _HOMES)

__all__ = [
    "EVERY_BIT",
    "GREY",
    "MEASURING",
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
    "Moment",
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

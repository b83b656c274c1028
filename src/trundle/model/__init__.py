"""World, Model, Link, Joint, …: frozen dataclasses with SDF's meaning, the narrow waist of Trundle."""

from .geometry import Box, Capsule, Cylinder, Ellipsoid, Geometry, MeshFile, Plane, Sphere
from .inertial import Inertial
from .joint import UNLIMITED, Joint, JointAxis, JointType
from .kinematics import model_from_joint, model_from_links
from .link import Collision, Link, Visual
from .material import GREY, Material, Rgba
from .plugin import PluginTag
from .sensor import CameraOptics, Sensor
from .surface import Surface
from .world import Light, Model, PhysicsSettings, World

__all__ = [
    "GREY",
    "UNLIMITED",
    "Box",
    "CameraOptics",
    "Capsule",
    "Collision",
    "Cylinder",
    "Ellipsoid",
    "Geometry",
    "Inertial",
    "Joint",
    "JointAxis",
    "JointType",
    "Light",
    "Link",
    "Material",
    "MeshFile",
    "Model",
    "PhysicsSettings",
    "Plane",
    "PluginTag",
    "Rgba",
    "Sensor",
    "Sphere",
    "Surface",
    "Visual",
    "World",
    "model_from_joint",
    "model_from_links",
]

"""Elements of new parts, with Gazebo's default values."""

import re
from xml.sax.saxutils import escape, quoteattr

from trundle.base.diagnostics import UsageError
from trundle.base.xmlnode import XmlElement
from trundle.gazebo.plugins import plugin_documentation

from .joint_fields import JOINT_TYPES, axis_count
from .sensor_fields import SENSOR_TYPES

_GEOMETRY = {
    "box": "<box><size>1 1 1</size></box>",
    "sphere": "<sphere><radius>0.5</radius></sphere>",
    "cylinder": "<cylinder><radius>0.5</radius><length>1</length></cylinder>",
    "capsule": "<capsule><radius>0.5</radius><length>1</length></capsule>",
    "ellipsoid": "<ellipsoid><radii>0.5 0.5 0.5</radii></ellipsoid>",
}
"""Geometry by kind; each is 1 m high, except for the capsule."""
_CENTER_HEIGHTS_M = {"capsule": 1.0}
_GREY = "<material><ambient>0.7 0.7 0.7 1</ambient><diffuse>0.7 0.7 0.7 1</diffuse></material>"
_NOISE = "<noise><type>gaussian</type><mean>0</mean><stddev>0.01</stddev></noise>"
_RAYS = (
    "<ray><scan><horizontal><samples>360</samples><resolution>1</resolution><min_angle>-3.14159</min_angle>"
    "<max_angle>3.14159</max_angle></horizontal></scan>"
    f"<range><min>0.1</min><max>10</max></range>{_NOISE}</ray>"
)
_CAMERA = (
    "<camera><horizontal_fov>1.047</horizontal_fov><image><width>320</width><height>240</height>"
    "<format>R8G8B8</format></image><clip><near>0.05</near><far>100</far></clip></camera>"
)
_SENSORS = {
    "ray": (10, _RAYS),
    "gpu_ray": (10, _RAYS),
    "camera": (30, _CAMERA),
    "depth": (20, _CAMERA),
    "imu": (100, "<imu/>"),
    "contact": (30, "<contact><collision>__default__</collision></contact>"),
    "sonar": (10, "<sonar><min>0.1</min><max>3</max><radius>0.3</radius></sonar>"),
}
"""Type → rate [Hz] and settings."""
_PUBLISHERS = {
    "ray": ("libgazebo_ros_laser.so", {"topicName": "scan", "frameName": "{link}"}),
    "gpu_ray": ("libgazebo_ros_gpu_laser.so", {"topicName": "scan", "frameName": "{link}"}),
    "camera": ("libgazebo_ros_camera.so", {"cameraName": "{name}", "frameName": "{link}"}),
    "depth": ("libgazebo_ros_openni_kinect.so", {"cameraName": "{name}", "frameName": "{link}"}),
    "imu": (
        "libgazebo_ros_imu_sensor.so",
        {"topicName": "imu", "bodyName": "{link}", "updateRateHZ": "100", "frameName": "{link}"},
    ),
    "contact": ("libgazebo_ros_bumper.so", {"bumperTopicName": "bumper", "frameName": "{link}"}),
}
"""Type → plugin of gazebo_ros that publishes its readings, and its parameters."""
_FILENAME = re.compile(r"[\w.+-]+(?:/[\w.+-]+)*")


def new_model(name: str) -> bytes:
    """Return the SDF of an empty model."""
    return (
        f'<?xml version="1.0"?>\n<sdf version="1.7">\n  <model name={quoteattr(name)}>\n  </model>\n</sdf>\n'.encode()
    )


def new_shape(tag: str, kind: str, name: str) -> XmlElement:
    """Return a <visual> or <collision>."""
    return XmlElement.parse(_shape(tag, kind, name))


def _shape(tag: str, kind: str, name: str) -> str:
    look = _GREY if tag == "visual" and kind in _GEOMETRY else ""
    return f"<{tag} name={quoteattr(name)}><geometry>{_geometry(kind)}</geometry>{look}</{tag}>"


def _geometry(kind: str) -> str:
    """Return the geometry of a simple shape or of a mesh URI."""
    if kind in _GEOMETRY:
        return _GEOMETRY[kind]
    if "://" not in kind and "." not in kind:
        raise UsageError(f"no shape {kind!r}; there are: {', '.join(_GEOMETRY)}, and URIs of meshes")
    return f"<mesh><uri>{escape(kind)}</uri></mesh>"


def new_link(kind: str, name: str, x: float) -> XmlElement:
    """Return a <link> of one shape of 1 kg on the ground, with a placeholder for its inertia."""
    z = _CENTER_HEIGHTS_M.get(kind, 0.5) if kind in _GEOMETRY else 0.0
    return XmlElement.parse(
        f"<link name={quoteattr(name)}><pose>{x:g} 0 {z:g} 0 0 0</pose>"
        "<inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>"
        f"{_shape('collision', kind, 'collision')}{_shape('visual', kind, 'visual')}</link>"
    )


def new_joint(kind: str, name: str, parent: str, child: str) -> XmlElement:
    """Return a <joint> at its child's origin."""
    if kind not in JOINT_TYPES:
        raise UsageError(f"no joint type {kind!r}; there are: {', '.join(JOINT_TYPES)}")
    limit = "<limit><lower>-1</lower><upper>1</upper></limit>" if kind == "prismatic" else ""
    axes = "".join(
        f"<{tag}><xyz>{direction}</xyz>{limit}</{tag}>"
        for tag, direction in (("axis", "0 0 1"), ("axis2", "1 0 0"))[: axis_count(kind)]
    )
    return XmlElement.parse(
        f'<joint name={quoteattr(name)} type="{kind}"><parent>{escape(parent)}</parent>'
        f"<child>{escape(child)}</child>{axes}</joint>"
    )


def new_sensor(kind: str, name: str, link: str, collision: str) -> XmlElement:
    """Return a <sensor> with the plugin that publishes its readings in ROS.

    Args:
        kind: sensor's type.
        name: sensor's name.
        link: name of its link.
        collision: name of the link's first collision.
    """
    if kind not in SENSOR_TYPES:
        raise UsageError(f"no sensor type {kind!r}; there are: {', '.join(SENSOR_TYPES)}")
    rate, settings = _SENSORS.get(kind, (10, ""))
    settings = settings.replace("__default__", escape(collision))
    plugin = ""
    if kind in _PUBLISHERS:
        filename, parameters = _PUBLISHERS[kind]
        values = {key: text.format(link=link, name=name) for key, text in parameters.items()}
        plugin = _plugin(filename, f"{name}_publisher", values)
    return XmlElement.parse(
        f'<sensor name={quoteattr(name)} type="{kind}"><always_on>true</always_on>'
        f"<update_rate>{rate}</update_rate>{settings}{plugin}</sensor>"
    )


def new_plugin(filename: str, name: str) -> XmlElement:
    """Return a <plugin> with the documented defaults of its parameters that name joints and links."""
    if not _FILENAME.fullmatch(filename):
        raise UsageError(f"{filename!r} is not a plugin's file name, such as libgazebo_ros_diff_drive.so")
    documentation = plugin_documentation(filename)
    documented = () if documentation is None else documentation.parameters
    suffixes = ("Joint", "BaseFrame", "bodyName", "frameName")
    parameters = {p.name: p.default for p in documented if p.name.endswith(suffixes)}
    return XmlElement.parse(_plugin(filename, name, parameters))


def _plugin(filename: str, name: str, parameters: dict[str, str]) -> str:
    children = "".join(f"<{key}>{escape(text)}</{key}>" for key, text in parameters.items())
    return f"<plugin name={quoteattr(name)} filename={quoteattr(filename)}>{children}</plugin>"

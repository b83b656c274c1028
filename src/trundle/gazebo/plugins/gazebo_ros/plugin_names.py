"""Names of one plugin of gazebo_ros: topics in its namespace, frames through its tf prefix.

The plugins differ in the meaning of a missing or empty <robotNamespace> and in the source of a frame's prefix: see
gazebo_plugins (gazebo_ros_utils.h, GazeboRos and GetRobotNamespace), kobuki_gazebo_plugins, velodyne_gazebo_plugins.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from itertools import takewhile
from pathlib import PurePosixPath
from typing import Literal, NamedTuple, Protocol

from trundle.robots.model import Model
from trundle.robots.names import ros_name
from trundle.robots.parameters import TagParameters
from trundle.ros import Message, Node, RosError

from .namespaces import join_topic


class NameRule(NamedTuple):
    """Rule by which a plugin resolves topics and frames."""

    missing_is_model: bool = False
    """A missing <robotNamespace> means the model's name; else the root."""
    empty_is_model: bool = False
    """An empty <robotNamespace> means the model's name; else the root."""
    prefix: Literal["tf_prefix", "else_namespace", "namespace"] = "tf_prefix"
    """Prefix of frames.

    - `tf_prefix`: the parameter tf_prefix.
    - `else_namespace`: the same; if it is unset, the namespace up to Melodic.
    - `namespace`: the namespace; if it is empty, the parameter tf_prefix.
    """


_MODEL = NameRule(missing_is_model=True, empty_is_model=True, prefix="else_namespace")
"""Rule of the constructor of gazebo_ros_utils' class GazeboRos for a model."""
_SENSOR = NameRule(empty_is_model=True, prefix="else_namespace")
"""Rule of gazebo_ros_utils' GetRobotNamespace."""
_VELODYNE = NameRule(prefix="namespace")
_RULES: dict[str, NameRule] = {
    "libgazebo_ros_camera.so": _SENSOR,
    "libgazebo_ros_depth_camera.so": _SENSOR,
    "libgazebo_ros_diff_drive.so": _MODEL,
    "libgazebo_ros_gpu_laser.so": _SENSOR,
    "libgazebo_ros_imu_sensor.so": NameRule(missing_is_model=True),
    "libgazebo_ros_joint_state_publisher.so": _MODEL,
    "libgazebo_ros_kobuki.so": _MODEL,
    "libgazebo_ros_laser.so": _SENSOR,
    "libgazebo_ros_multicamera.so": _SENSOR,
    "libgazebo_ros_openni_kinect.so": _SENSOR,
    "libgazebo_ros_thermal_camera.so": _SENSOR,
    "libgazebo_ros_tricycle_drive.so": _MODEL,
    "libgazebo_ros_triggered_camera.so": _SENSOR,
    "libgazebo_ros_triggered_multicamera.so": _SENSOR,
    "libgazebo_ros_velodyne_gpu_laser.so": _VELODYNE,
    "libgazebo_ros_velodyne_laser.so": _VELODYNE,
}
"""File name → rule; all others have the defaults."""
_DRIVES = frozenset(
    {
        "libgazebo_ros_diff_drive.so",
        "libgazebo_ros_force_based_move.so",
        "libgazebo_ros_planar_move.so",
        "libgazebo_ros_skid_steer_drive.so",
        "libgazebo_ros_tricycle_drive.so",
        "libridgeback_ros_force_based_move.so",
        "librobotnik_force_based_move.so",
    }
)
"""Plugins with <commandTopic>, <odometryFrame> and <robotBaseFrame>."""


class TopicPublisher(Protocol):
    """Publisher on one topic or several."""

    @property
    def has_subscribers(self) -> bool:
        """True if any topic has a subscriber."""
        ...

    def publish(self, message: Mapping[str, object], /) -> None:
        """Publish on each topic."""
        ...


class PluginNames:
    """Topics and frames of one plugin.

    A plugin whose namespace defaults to the model's name also has its topics at the root, as long as they are
    unambiguous (docs/decisions/0014).
    """

    def __init__(self, node: Node, parameters: TagParameters, model: Model, models: Sequence[Model]) -> None:
        """Read <robotNamespace>.

        Args:
            node: publishes and subscribes; reads tf_prefix.
            parameters: plugin's parameters.
            model: model of the plugin or sensor.
            models: all models of the world.
        """
        self.node = node
        self._report = parameters.report
        rule = _RULES.get(_file_name(parameters.attribute("filename")), NameRule())
        self._prefix_rule = rule.prefix
        is_missing = "robotNamespace" not in parameters
        namespace = parameters.text("robotNamespace", "")
        uses_model_name = rule.missing_is_model if is_missing else rule.empty_is_model and not namespace
        self.namespace = ros_name(model.name) if uses_model_name else namespace.strip("/")
        """Without slashes at its ends; empty: the root."""
        others = [other for other in models if other.name != model.name]
        self._is_also_at_root = is_missing and uses_model_name and not any(map(_is_ambiguous_at_root, others))
        self._model, self._models = model, models

    def topics(self, *names: str) -> list[str]:
        """Return a topic's global names: each name in the namespace and, if no other model claims it, at the root."""
        topics = [join_topic(self.namespace, name) for name in names]
        if self._is_also_at_root:
            topics += [join_topic("", name) for name in names]
        return list(dict.fromkeys(topics))

    def topic(self, name: str) -> str:
        """Return the global name of a topic, as in the original."""
        return join_topic(self.namespace, name)

    def advertise(self, kind: str, *names: str, queue_size: int = 1) -> TopicPublisher:
        """Advertise a topic under all its names; see `topics`."""
        publishers = [self.node.advertise(topic, kind, queue_size=queue_size) for topic in self.topics(*names)]
        return publishers[0] if len(publishers) == 1 else _PublisherGroup(publishers)

    def subscribe(self, name: str, kind: str, callback: Callable[[Message], None], *, queue_size: int = 1) -> None:
        """Subscribe to a topic."""
        for topic in self.topics(name):
            self.node.subscribe(topic, kind, callback, queue_size=queue_size)

    def frame(self, name: str) -> str:
        """Return the frame with its prefix; a leading slash means no prefix (tf::resolve)."""
        if name.startswith("/") or not self._prefix:
            return name.lstrip("/")
        return f"{self._prefix}/{name}"

    def drives_before(self) -> Iterator[tuple[str, TagParameters, "PluginNames"]]:
        """Yield the drives of the models before this one: the model's name, the drive's parameters and names."""
        for model in takewhile(lambda model: model.name != self._model.name, self._models):
            for tag in model.plugins:
                if _file_name(tag.filename) in _DRIVES:
                    parameters = TagParameters(tag.node, self._report)
                    yield model.name, parameters, PluginNames(self.node, parameters, model, self._models)

    @cached_property
    def _prefix(self) -> str:
        if self._prefix_rule == "namespace" and self.namespace:
            return self.namespace
        tf_prefix = self._tf_prefix()
        if not tf_prefix and self._prefix_rule == "else_namespace" and self.node.profile.namespace_is_tf_prefix:
            return self.namespace
        return tf_prefix

    def _tf_prefix(self) -> str:
        """Return the parameter tf_prefix of the namespace, or of its nearest ancestor that has one (getPrefixParam)."""
        parts = [part for part in self.namespace.split("/") if part]
        try:
            for length in range(len(parts), -1, -1):
                name = "/".join(["", *parts[:length], "tf_prefix"])
                prefix = self.node.loop.run(self.node.params.get(name, None))
                if isinstance(prefix, str):
                    return prefix.strip("/")
        except RosError as error:
            self.node.log.warn(f"tf_prefix: {error}; frames have no prefix")
        return ""


class _PublisherGroup:
    """Publisher of the same messages on several topics."""

    def __init__(self, publishers: Sequence[TopicPublisher]) -> None:
        self._publishers = publishers

    @property
    def has_subscribers(self) -> bool:
        """True if any topic has a subscriber."""
        return any(publisher.has_subscribers for publisher in self._publishers)

    def publish(self, message: Mapping[str, object], /) -> None:
        """Publish on each topic that has a subscriber."""
        for publisher in self._publishers:
            if publisher.has_subscribers:
                publisher.publish(message)


def _is_ambiguous_at_root(model: Model) -> bool:
    """Return True if a plugin of the model or of its sensors could claim a topic at the root."""
    sensor_tags = (tag for link in model.links for sensor in link.sensors for tag in sensor.plugins)
    return any(
        tag.node.find("robotNamespace") is None
        and (_file_name(tag.filename) in _DRIVES or _RULES.get(_file_name(tag.filename), NameRule()).missing_is_model)
        for tag in (*model.plugins, *sensor_tags)
    )


def _file_name(filename: str) -> str:
    return PurePosixPath(filename.replace("\\", "/")).name

"""ROS interfaces of the models of a world: topics of their sensors, nodes of their plugins."""

from collections.abc import Callable, Mapping, Sequence

from trundle.gazebo.model_plugins import attach_sensor_plugins
from trundle.robots.robot import Robot
from trundle.ros import Endpoint, Node, StaticTransformBroadcaster
from trundle.ros.bridge import FrameNames, make_camera_topics, make_sensor_topics
from trundle.sim.sensors import CameraSensor, InstrumentSensor
from trundle.sim.simulation import ModelHandle, Simulation


class ModelInterfaces:
    """Topics and nodes of one simulation's models, which end with their model."""

    def __init__(
        self,
        node: Node,
        static_broadcaster: StaticTransformBroadcaster,
        simulation: Simulation,
        make_node: Callable[[str], Node],
        *,
        frames: FrameNames | None = None,
    ) -> None:
        """Prepare.

        Args:
            node: publishes the sensors' readings.
            static_broadcaster: broadcaster of the node's /tf_static.
            simulation: the models' simulation.
            make_node: makes a plugin's node from its name.
            frames: names of the sensors' frames; None: robot_state_publisher's if a model is the only robot, else
                scoped names.
        """
        self._node = node
        self._static_broadcaster = static_broadcaster
        self._simulation = simulation
        self._make_node = make_node
        self._frames = frames
        self._endpoints: dict[ModelHandle, list[Endpoint]] = {}
        self._nodes: dict[ModelHandle | None, list[Node]] = {}
        """Nodes of each model's plugins; the key None: nodes of the world's plugins."""

    def node_maker(self, model: ModelHandle | None) -> Callable[[str], Node]:
        """Return a function that makes nodes for a model's plugins; None: for the world's plugins."""

        def make(name: str) -> Node:
            node = self._make_node(name)
            self._nodes.setdefault(model, []).append(node)
            return node

        return make

    def advertise(
        self,
        model: ModelHandle,
        cameras: Sequence[CameraSensor],
        sensors: Sequence[InstrumentSensor],
        lone_robot: Robot | None,
        environment: Mapping[str, str],
    ) -> None:
        """Advertise the topics of the sensors of a model.

        Args:
            model: model with the sensors.
            cameras: the model's cameras.
            sensors: the model's other sensors.
            lone_robot: the model's URDF, if it is the only robot.
            environment: variables that locate compiled plugins.
        """
        if not cameras and not sensors:
            return
        names = self._frames
        if names is None:
            names = FrameNames() if lone_robot is None else FrameNames.from_robot(lone_robot)
        node, simulation = self._node, self._simulation
        with node.endpoints.record() as self._endpoints[model]:
            silent_cameras = attach_sensor_plugins(cameras, node, simulation, environment)
            make_camera_topics(node, self._static_broadcaster, silent_cameras, names)
            silent_sensors = attach_sensor_plugins(sensors, node, simulation, environment)
            make_sensor_topics(node, self._static_broadcaster, silent_sensors, names)

    def unload(self, model: ModelHandle) -> None:
        """Shut down the nodes of a deleted model; unregister its topics unless another model shares them."""
        for node in self._nodes.pop(model, []):
            node.loop.run(node.shutdown())
        endpoints = self._endpoints.pop(model, [])
        shared = {id(endpoint) for others in self._endpoints.values() for endpoint in others}
        for endpoint in endpoints:
            if id(endpoint) not in shared:
                endpoint.unregister()

    @property
    def changes(self) -> int:
        """Number of topics and services that the plugins' nodes have added or removed."""
        return sum(node.endpoints.changes for nodes in self._nodes.values() for node in nodes)

    def close(self) -> None:
        """Shut down the plugins' nodes without waiting; from any thread."""
        for node in (node for nodes in self._nodes.values() for node in nodes):
            node.loop.spawn(node.shutdown())
        self._nodes.clear()

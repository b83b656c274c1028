"""Topics of running containers' structure and state, for smach_viewer, which may also set their initial states."""

import threading
from collections.abc import Sequence
from typing import Any

from smach_msgs.msg import SmachContainerInitialStatusCmd, SmachContainerStatus, SmachContainerStructure
from std_msgs.msg import Header

import genpy
import rospy
import smach

from . import local_data

STATUS_TOPIC = "/smach/container_status"
INIT_TOPIC = "/smach/container_init"
STRUCTURE_TOPIC = "/smach/container_structure"

_PERIOD = rospy.Duration(2.0)


class IntrospectionClient:
    """Finds servers and sets initial states."""

    def get_servers(self) -> list[str]:
        """Names of all servers."""
        import rostopic

        return [topic[: topic.rfind(STATUS_TOPIC)] for topic in rostopic.find_by_type(SmachContainerStatus._type)]

    def set_initial_state(
        self,
        server: str,
        path: str,
        initial_states: Sequence[str],
        initial_userdata: smach.UserData | None = None,
        timeout: genpy.Duration | None = None,
    ) -> bool | None:
        """Set the initial states of a container.

        Args:
            server: container's server.
            path: container's path.
            initial_states: labels of the states.
            initial_userdata: UserData of plain values.
            timeout: rospy.Duration to wait for the answer; None: do not wait.

        Returns:
            True if the container reports these states and values; None without a timeout.
        """
        values = initial_userdata._data if initial_userdata is not None else {}
        command = SmachContainerInitialStatusCmd(
            path=path, initial_states=initial_states, local_data=local_data.encode(values)
        )
        is_applied = threading.Event()

        def on_status(status: Any) -> None:
            if status.path == path and all(state in status.initial_states for state in initial_states):
                data = local_data.decode(status.local_data)
                if all(data.get(key) == value for key, value in values.items()):
                    is_applied.set()

        subscriber = rospy.Subscriber(server + STATUS_TOPIC, SmachContainerStatus, on_status)
        publisher = rospy.Publisher(server + INIT_TOPIC, SmachContainerInitialStatusCmd, queue_size=1)
        publisher.publish(command)
        if timeout is None:
            return None
        end = rospy.Time.now() + timeout
        while not is_applied.wait(0.3) and rospy.Time.now() < end and not rospy.is_shutdown():
            publisher.publish(command)
        subscriber.unregister()
        return is_applied.is_set()


class ContainerProxy:
    """Topics of one container."""

    def __init__(
        self, server_name: str, container: smach.Container, path: str, update_rate: genpy.Duration = _PERIOD
    ) -> None:
        self._path = path
        self._container = container
        self._update_rate = update_rate
        self._lock = threading.Lock()
        self._timer: rospy.Timer | None = None
        self._init_cmd = rospy.Subscriber(server_name + INIT_TOPIC, SmachContainerInitialStatusCmd, self._init_cmd_cb)
        self._structure_pub = rospy.Publisher(server_name + STRUCTURE_TOPIC, SmachContainerStructure, queue_size=1)
        self._status_pub = rospy.Publisher(server_name + STATUS_TOPIC, SmachContainerStatus, queue_size=1)
        container.register_transition_cb(lambda *args: self.publish_status(str(args)))

    def start(self) -> None:
        """Publish now and periodically."""
        self._publish()
        self._timer = rospy.Timer(self._update_rate, self._publish)

    def stop(self) -> None:
        """Stop publishing, and ignore commands."""
        if self._timer is not None:
            self._timer.shutdown()
        for endpoint in (self._init_cmd, self._structure_pub, self._status_pub):
            endpoint.unregister()

    def _publish(self, _event: object = None) -> None:
        self.publish_status("HEARTBEAT")
        edges = self._container.get_internal_edges()
        structure = SmachContainerStructure(
            Header(stamp=rospy.Time.now()),
            self._path,
            list(self._container.get_children()),
            [str(outcome) for outcome, _, _ in edges],
            [str(label) for _, label, _ in edges],
            [str(target) for _, _, target in edges],
            list(self._container.get_registered_outcomes()),
        )
        self._send(self._structure_pub, structure)

    def publish_status(self, info: str = "") -> None:
        """Publish the state now."""
        with self._lock:
            status = SmachContainerStatus(
                Header(stamp=rospy.Time.now()),
                self._path,
                self._container.get_initial_states(),
                self._container.get_active_states(),
                local_data.encode(self._container.userdata._data),
                info,
            )
            self._send(self._status_pub, status)

    def _send(self, publisher: rospy.Publisher, message: Any) -> None:
        try:
            publisher.publish(message)
        except rospy.ROSException as error:
            if not rospy.is_shutdown():
                rospy.logerr(f"smach introspection of {self._path}: {error}")

    def _init_cmd_cb(self, msg: Any) -> None:
        if msg.path != self._path:
            return
        children = self._container.get_children()
        unknown = [state for state in msg.initial_states if state not in children]
        if unknown:
            rospy.logerr(f"container '{self._path}' has no state {', '.join(unknown)}; it has {', '.join(children)}")
            return
        userdata = smach.UserData()
        try:
            userdata._data = local_data.decode(msg.local_data)
        except ValueError as error:
            rospy.logerr(f"container '{self._path}': {error}")
            return
        self._container.set_initial_state(msg.initial_states, userdata)
        self.publish_status("REMOTE_INIT")


class IntrospectionServer:
    """Topics of a container and all containers in it."""

    def __init__(self, server_name: str, state: smach.Container, path: str) -> None:
        """Create; see `start`.

        Args:
            server_name: server's name, the prefix of its topics.
            state: outermost container.
            path: container's path, often /SM_ROOT.
        """
        self._proxies: list[ContainerProxy] = []
        self._server_name = server_name
        self._state = state
        self._path = path

    def start(self) -> None:
        """Publish."""
        self.construct(self._server_name, self._state, self._path)

    def stop(self) -> None:
        """Stop publishing."""
        for proxy in self._proxies:
            proxy.stop()

    def construct(self, server_name: str, state: smach.Container, path: str) -> None:
        """Publish a container and all containers in it."""
        proxy = ContainerProxy(server_name, state, path)
        for label, child in state.get_children().items():
            if isinstance(child, smach.Container):
                self.construct(server_name, child, f"{'' if path == '/' else path}/{label}")
        proxy.publish_status("Initial state")
        proxy.start()
        self._proxies.append(proxy)

    def clear(self) -> None:
        """Forget all containers."""
        self._proxies = []

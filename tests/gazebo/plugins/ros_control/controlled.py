"""Robot behind ros_control in a running world."""

from concurrent.futures import Future
from typing import Any

from tests.gazebo_server import PATIENCE_S, Gazebo, until

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.controller_manager import Spawner
from trundle.ros import Message, Node

INERTIAL = '<inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>'


def driven(name: str, kind: str, interface: str, *, axis: str = "1 0 0", limit: str = "") -> str:
    return f"""<link name="{name}_link">{INERTIAL}</link>
<joint name="{name}" type="{kind}"><parent link="base"/><child link="{name}_link"/><axis xyz="{axis}"/>{limit}</joint>
<transmission name="{name}_t"><type>transmission_interface/SimpleTransmission</type>
<joint name="{name}"><hardwareInterface>hardware_interface/{interface}</hardwareInterface></joint>
<actuator name="{name}_m"><mechanicalReduction>1</mechanicalReduction></actuator></transmission>"""


def fixed_robot(*joints: str) -> str:
    """Return a robot fixed to the world, with the given joints."""
    return f"""<robot name="r"><link name="world"/><link name="base">{INERTIAL}</link>
<joint name="fix" type="fixed"><parent link="world"/><child link="base"/><origin xyz="0 0 5"/></joint>
{"".join(joints)}
<gazebo><plugin name="control" filename="libgazebo_ros_control.so"><robotNamespace>/r</robotNamespace></plugin></gazebo>
</robot>"""


MANAGER = "/r/controller_manager"
PACKAGE = "controller_manager_msgs"


class Robot:
    """Robot with its controller_manager and joint states."""

    def __init__(self, gazebo: Gazebo, urdf: str, controllers: dict[str, Any]) -> None:
        self.gazebo = gazebo
        self._spawners: list[tuple[Future[int], Node]] = []
        for name, value in controllers.items():
            gazebo.loop.run(gazebo.client.params.set(f"/r/{name}", value))
        gazebo.loop.run(gazebo.client.params.set("/r/robot_description", urdf))
        answer = gazebo.call(
            "spawn_urdf_model", "gazebo_msgs/SpawnModel", model_name="r", model_xml=urdf, robot_namespace="/r"
        )
        assert answer.success, answer.status_message
        gazebo.call("unpause_physics")

    def spawn(self, *arguments: str) -> None:
        """Start controllers as a launch file does, and wait until they run."""
        name, uri = f"/r/spawner{len(self._spawners)}", self.gazebo.client.master_uri
        node = Node(name, loop=self.gazebo.loop, master_uri=uri)
        self._spawners.append((self.gazebo.loop.spawn(Spawner(node, list(arguments), NodeHost()).run()), node))
        names = {argument for argument in arguments if not argument.startswith("--")}
        state = "initialized" if "--stopped" in arguments else "running"
        until(lambda: names <= {c.name for c in self.list() if c.state == state})

    def list(self) -> list[Message]:
        """List the loaded controllers."""
        wait = self.gazebo.client.wait_for_service(f"{MANAGER}/list_controllers", PATIENCE_S)
        self.gazebo.loop.run(wait, timeout_s=PATIENCE_S)
        return list(self.call("list_controllers", "ListControllers").controller)

    def call(self, service: str, kind: str, **fields: Any) -> Message:
        """Call a service of the controller_manager."""
        call = self.gazebo.client.call_service(f"{MANAGER}/{service}", f"{PACKAGE}/{kind}", fields)
        return self.gazebo.loop.run(call, timeout_s=PATIENCE_S)

    def command(self, controller: str, value: float) -> None:
        """Publish a controller's command."""
        self.gazebo.advertise(f"/r/{controller}/command", "std_msgs/Float64")({"data": value})

    def joint(self, name: str) -> Message:
        """Return the properties of a joint."""
        return self.gazebo.call("get_joint_properties", "gazebo_msgs/GetJointProperties", joint_name=f"r::{name}")

    def stop_spawner(self, number: int) -> int:
        """Shut a spawner down as `rosnode kill` does; return its exit code."""
        future, node = self._spawners[number]
        self.gazebo.loop.run(node.shutdown(), timeout_s=PATIENCE_S)
        return future.result(PATIENCE_S)

    def close(self) -> None:
        """Shut down the spawners."""
        for future, node in self._spawners:
            future.cancel()
            self.gazebo.loop.run(node.shutdown(), timeout_s=PATIENCE_S)

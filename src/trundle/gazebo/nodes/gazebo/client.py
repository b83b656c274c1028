"""gazebo_ros/gzclient: the window of the simulation."""

from trundle.ros import Node

from ..host import NodeHost


class GazeboClient:
    """Shows the simulated world on the page; without a page it idles, where gzclient would fail without a display."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments
        self._node = node
        self._simulator = host.simulator

    async def run(self) -> int:
        """Show until cancelled."""
        if self._simulator is not None:
            return await self._simulator.show(self._node)
        self._node.log.warn("no world is simulated in this process; gazebo_ros/gazebo starts both world and window")
        await self._node.closed.wait()
        return 0

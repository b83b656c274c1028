"""nodelet/nodelet: managers that idle, and nodelets that a stand-in of ours can be."""

from trundle.ros import Node

from .find import Replacement
from .host import Host

NODELETS: dict[str, str] = {
    "depthimage_to_laserscan/DepthImageToLaserScanNodelet": (
        "trundle.nodes.depthimage_to_laserscan:DepthImageToLaserScan"
    ),
    "pointcloud_to_laserscan/PointCloudToLaserScanNodelet": (
        "trundle.nodes.pointcloud_to_laserscan:PointCloudToLaserScan"
    ),
    "pointcloud_to_laserscan/pointcloud_to_laserscan_nodelet": (
        "trundle.nodes.pointcloud_to_laserscan:PointCloudToLaserScan"
    ),
}
"""Class as launch files name it → "module:Class"."""


class Nodelet:
    """Is the nodelet that it is told to load; one that nothing stands in for is named, and the launch goes on."""

    def __init__(self, node: Node, arguments: list[str], host: Host) -> None:
        self._node = node
        self._arguments = [word for word in arguments if not word.startswith("--")]
        self._host = host

    async def run(self) -> int:
        """Run until cancelled."""
        node = self._node
        match self._arguments:
            case ["manager", *_]:
                await node.closed.wait()
                return 0
            case ["load", name, _, *rest] | ["standalone", name, *rest]:
                if name in NODELETS:
                    return await Replacement(NODELETS[name]).load()(node, rest, self._host).run()
                known = ", ".join(NODELETS)
                node.log_warn(f"nodelet {name}: compiled code that nothing stands in for; there are: {known}")
                await node.closed.wait()
                return 0
            case ["unload", *_]:
                return 0
            case words:
                node.log_error(
                    f"usage: nodelet manager|load|standalone|unload CLASS [MANAGER]; got {' '.join(words)!r}"
                )
                return 1

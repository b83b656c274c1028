"""libgazebo_ros_link_attacher.so: services that weld links of two models together, and release them."""

from typing import Self

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.robots.model import Joint, JointType, PluginTag
from trundle.ros import Message, Node
from trundle.sim.simulation import Simulation

from .plugin import WorldPlugin

_NODE = "/link_attacher_node"
_KIND = "gazebo_ros_link_attacher/Attach"


class LinkAttacher(WorldPlugin):
    """`/link_attacher_node/attach` and `/link_attacher_node/detach` (gazebo_ros_link_attacher/Attach); no parameters.

    As in the original, detach needs the names in the order of attach and may be repeated; attaching again welds the
    links in their current poses.
    """

    period_ns = 1 << 62  # the plugin acts on requests only

    def __init__(self, sim: Simulation, node: Node, tag: PluginTag) -> None:
        self._sim, self._node, self._at = sim, node, tag.at
        self._attached: set[str] = set()
        node.advertise_service(f"{_NODE}/attach", _KIND, self._attach)
        node.advertise_service(f"{_NODE}/detach", _KIND, self._detach)
        tag.node.report_unread(sim.report)

    @classmethod
    def load(cls, sim: Simulation, node: Node | None, tag: PluginTag) -> Self:
        """See `WorldPlugin.load`."""
        if node is None:
            raise TrundleError("it needs the ROS graph, which --no-ros leaves out")
        return cls(sim, node, tag)

    def _attach(self, request: Message) -> dict[str, object]:
        parent, child = _requested_links(request)
        name = _joint_name(parent, child)
        try:
            if not any(joint.name == name for joint in self._sim.joints):
                self._join(name, self._link(*parent), self._link(*child))
        except TrundleError as error:
            self._node.log.error(f"attach: {error}")
            return {"ok": False}
        self._attached.add(name)
        self._node.log.info(f"attached {'::'.join(parent)} to {'::'.join(child)}")
        return {"ok": True}

    def _detach(self, request: Message) -> dict[str, object]:
        parent, child = _requested_links(request)
        name = _joint_name(parent, child)
        if name not in self._attached:
            links = f"{'::'.join(parent)} to {'::'.join(child)}"
            self._node.log.error(f"detach: nothing was attached from {links}; the order counts")
            return {"ok": False}
        if any(joint.name == name for joint in self._sim.joints):
            self._sim.detach(name)
        self._node.log.info(f"detached {'::'.join(parent)} from {'::'.join(child)}")
        return {"ok": True}

    def _join(self, name: str, parent: str, child: str) -> None:
        if parent == child:
            raise UsageError(f"link {parent!r} cannot be attached to itself")
        self._sim.attach(Joint(name=name, type=JointType.FIXED, parent=parent, child=child, at=self._at))

    def _link(self, model: str, link: str) -> str:
        """Return `model::link` of an existing link."""
        return f"{model}::{self._sim[model].link(link).name}"


def _requested_links(request: Message) -> tuple[tuple[str, str], tuple[str, str]]:
    """Return both links as (model, link); a link's name may have its model's name as prefix."""
    one, other = str(request.model_name_1), str(request.model_name_2)
    links = str(request.link_name_1).removeprefix(f"{one}::"), str(request.link_name_2).removeprefix(f"{other}::")
    return (one, links[0]), (other, links[1])


def _joint_name(parent: tuple[str, str], child: tuple[str, str]) -> str:
    return f"attached::{'::'.join(parent)}::{'::'.join(child)}"

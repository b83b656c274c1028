"""libgazebo_ros_link_attacher.so: links of two models welded together, and parted again, by services."""

from typing import Self

from trundle.diagnostics import TrundleError, UsageError
from trundle.model import Joint, JointType, PluginTag
from trundle.ros import Message, Node
from trundle.simulation import Simulation

from .plugin import WorldPlugin

_NODE = "/link_attacher_node"
_KIND = "gazebo_ros_link_attacher/Attach"


class LinkAttacher(WorldPlugin):
    """`/link_attacher_node/attach` and `/link_attacher_node/detach` (gazebo_ros_link_attacher/Attach); no parameters.

    As in the original, what was joined is parted by the same names in the same order, also a second time, and
    what was parted is joined anew where it is then.
    """

    period_ns = 1 << 62  # it acts when it is asked

    def __init__(self, sim: Simulation, node: Node, tag: PluginTag) -> None:
        self._sim, self._node, self._at = sim, node, tag.at
        self._known: set[str] = set()
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
        parent, child = _asked(request)
        name = _joint_name(parent, child)
        try:
            if not any(joint.name == name for joint in self._sim.joints):
                self._join(name, self._link(*parent), self._link(*child))
        except TrundleError as error:
            self._node.log.error(f"attach: {error}")
            return {"ok": False}
        self._known.add(name)
        self._node.log.info(f"attached {'::'.join(parent)} to {'::'.join(child)}")
        return {"ok": True}

    def _detach(self, request: Message) -> dict[str, object]:
        parent, child = _asked(request)
        name = _joint_name(parent, child)
        if name not in self._known:
            both = f"{'::'.join(parent)} to {'::'.join(child)}"
            self._node.log.error(f"detach: nothing was attached from {both}; the order counts")
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
        """`model::link`, after making sure that there is one."""
        return f"{model}::{self._sim[model].link(link).name}"


def _asked(request: Message) -> tuple[tuple[str, str], tuple[str, str]]:
    """Model and link of both; a link may be named with its model's name before it."""
    one, other = str(request.model_name_1), str(request.model_name_2)
    links = str(request.link_name_1).removeprefix(f"{one}::"), str(request.link_name_2).removeprefix(f"{other}::")
    return (one, links[0]), (other, links[1])


def _joint_name(parent: tuple[str, str], child: tuple[str, str]) -> str:
    return f"attached::{'::'.join(parent)}::{'::'.join(child)}"

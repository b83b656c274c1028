"""Joints that plugins let follow others, which Gazebo's conversion leaves free."""

from collections.abc import Iterable

from trundle.robots.model import Mimic, PluginTag


def plugin_followers(plugins: Iterable[PluginTag]) -> dict[str, Mimic | None]:
    """Return the joints that <mimicJoint>s name, and what they mimic; None: the plugin drives the joint itself.

    libroboticsgroup_gazebo_mimic_joint_plugin.so sets the follower's position, unless <hasPID> limits its effort. That
    is a coupling of joints, as exact as one of a robot's own <mimic>.
    """
    found: dict[str, Mimic | None] = {}
    for plugin in plugins:
        for follower in plugin.node.all("mimicJoint"):
            sets_position = "mimic_joint_plugin" in plugin.filename and plugin.node.find("hasPID") is None
            found[follower.text] = _mimic(plugin) if sets_position else None
    return found


def _mimic(plugin: PluginTag) -> Mimic:
    node = plugin.node
    return Mimic(
        joint=node.string("joint"),
        multiplier=node.number("multiplier", default=1.0),
        offset=node.number("offset", default=0.0),
    )

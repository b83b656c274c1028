"""Joints that plugins of mimic joints drive; Gazebo's conversion leaves them free."""

from collections.abc import Iterable

from trundle.robots.model import Mimic, PluginTag


def plugin_followers(plugins: Iterable[PluginTag]) -> dict[str, Mimic | None]:
    """Return the mimic of each joint named by a <mimicJoint>; None if the plugin drives the joint by effort.

    libroboticsgroup_gazebo_mimic_joint_plugin.so sets the follower's position, unless <hasPID> limits its effort; this
    is as exact a coupling as the robot's own <mimic>.
    """
    followers: dict[str, Mimic | None] = {}
    for plugin in plugins:
        for follower in plugin.node.all("mimicJoint"):
            sets_position = "mimic_joint_plugin" in plugin.filename and plugin.node.find("hasPID") is None
            followers[follower.text] = _mimic(plugin) if sets_position else None
    return followers


def _mimic(plugin: PluginTag) -> Mimic:
    node = plugin.node
    return Mimic(
        joint=node.string("joint"),
        multiplier=node.number("multiplier", default=1.0),
        offset=node.number("offset", default=0.0),
    )

"""Frames of a drive's wheels on /tf."""

from collections.abc import Mapping

from trundle.ros import Transform, TransformBroadcaster
from trundle.sim.simulation import JointHandle, ModelHandle

from .plugin_names import PluginNames


class WheelFrames:
    """Sends the pose of each wheel in its parent link."""

    def __init__(self, names: PluginNames, model: ModelHandle, wheels: Mapping[str, JointHandle]) -> None:
        """Advertise.

        Args:
            names: plugin's names.
            model: model of the wheels.
            wheels: frame of the wheel, without its prefix → wheel's joint.
        """
        self._broadcaster = TransformBroadcaster(names.node)
        self._wheels = [
            (names.frame(joint.parent), names.frame(frame), model.link(joint.parent), model.link(joint.child))
            for frame, joint in ((frame, handle.joint) for frame, handle in wheels.items())
        ]

    def send(self, time_ns: int) -> None:
        """Send the frames, if there is a subscriber."""
        if not self._broadcaster.has_subscribers:
            return
        transforms: list[Transform] = []
        for parent, child, parent_link, wheel_link in self._wheels:
            pose = parent_link.pose.inverse() @ wheel_link.pose
            position, rotation = pose.position, pose.quaternion
            transforms.append(
                Transform(parent=parent, child=child, stamp_ns=time_ns, translation=position, rotation=rotation)
            )
        self._broadcaster.send_transform(*transforms)

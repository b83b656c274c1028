"""Frames in messages: links, objects and their subframes, fixed ones, and what tf knows."""

from typing import TYPE_CHECKING

import numpy as np

from trundle.base.diagnostics import TrundleError
from trundle.ros import TransformBuffer, TransformError
from trundle.spatial import Pose

if TYPE_CHECKING:
    from trundle.planning.kinematics import Kinematics
    from trundle.planning.robot_model import RobotModel

    from .scene_contents import SceneContents


class FrameError(TrundleError):
    """A frame that nothing knows."""


class Frames:
    """Poses of frames in the model's, at one state of the robot."""

    def __init__(
        self,
        model: "RobotModel",
        kinematics: "Kinematics",
        positions: np.ndarray,
        contents: "SceneContents",
        buffer: TransformBuffer | None,
    ) -> None:
        """Hold the state.

        Args:
            model: robot.
            kinematics: of the model.
            positions: state vector.
            contents: objects, whose names are frames as well.
            buffer: tf, for frames that are neither; None: there is none.
        """
        self._model = model
        self._contents = contents
        self._buffer = buffer
        self._rows = dict(zip(model.links, kinematics.link_poses(positions), strict=True))

    def link(self, name: str) -> Pose:
        """Return the pose of a link."""
        x, y, z, qx, qy, qz, qw = (float(number) for number in self._rows[name])
        return Pose((x, y, z), (qw, qx, qy, qz))

    def find(self, frame: str) -> Pose:
        """Return the pose of a frame; the empty name is the model's frame.

        Raises:
            FrameError: nothing knows the frame.
        """
        name = frame.lstrip("/")
        if not name or name == self._model.model_frame:
            return Pose()
        if name in self._rows:
            return self.link(name)
        found = self._of_object(name)
        if found is not None:
            return found
        if self._buffer is not None:
            root = self._model.model_frame
            for target, before in ((root, Pose()), (self._model.root_link, self.link(self._model.root_link))):
                try:
                    return before @ self._buffer.lookup_transform(target, name).pose
                except TransformError:
                    continue
        raise FrameError(
            f"Unable to transform from frame '{frame}' to frame '{self._model.model_frame}': it is neither a link nor "
            "an object, and tf does not know it"
        )

    def _of_object(self, name: str) -> Pose | None:
        base, _, subframe = name.partition("/")
        for full, sub in ((name, ""), (base, subframe)):
            if full in self._contents.objects:
                found = self._contents.objects[full]
                pose, subframes = found.pose, found.subframes
            elif full in self._contents.carried:
                carried = self._contents.carried[full]
                pose, subframes = self.link(carried.link) @ carried.object.pose, carried.object.subframes
            else:
                continue
            if not sub:
                return pose
            return pose @ subframes[sub] if sub in subframes else None
        return None

"""Depth cameras: how far away each pixel's surface is."""

import numpy as np

from trundle.simulation import Snapshot

from .camera import CameraReading, CameraSensor


class DepthCameraSensor(CameraSensor):
    """Sees colours and depths from one place, as Gazebo's depth cameras do."""

    def take(self, snapshot: Snapshot) -> CameraReading:
        """Take both pictures; as gazebo_ros' openni plugin has it, depths out of range are not numbers."""
        picture = self.look(snapshot, depth=True)
        assert picture.depth is not None
        near, far = self.optics.depth_near_m, self.optics.depth_far_m
        depth = picture.depth.copy()
        depth[~np.isfinite(depth)] = np.nan
        with np.errstate(invalid="ignore"):
            if near is not None:
                depth[depth < near] = np.nan
            if far is not None:
                depth[depth > far] = np.nan
        return CameraReading(time_ns=snapshot.time_ns, rgb=picture.rgb, depth=depth)

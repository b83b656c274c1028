"""Depth cameras: how far away each pixel's surface is."""

import numpy as np

from trundle.model import Noise
from trundle.render import add_depth_noise
from trundle.simulation import Snapshot

from .camera import CameraReading, CameraSensor


class DepthCameraSensor(CameraSensor):
    """Sees colours and depths from one place, as Gazebo's depth cameras do."""

    sees_depth = True

    def take(self, snapshot: Snapshot) -> CameraReading:
        """Take both pictures; as in gazebo_ros' openni plugin, depths out of range are not numbers."""
        picture = self.look(snapshot)
        assert picture.depth is not None
        noise = self.optics.noise
        near, far = self.optics.depth_near_m, self.optics.depth_far_m
        depth = np.ascontiguousarray(picture.depth)
        depth[~np.isfinite(depth)] = np.nan
        if noise != Noise():
            add_depth_noise(depth, seed=self.noise_seed(), mean=noise.mean, stddev=noise.stddev)
        with np.errstate(invalid="ignore"):
            if near is not None:
                depth[depth < near] = np.nan
            if far is not None:
                depth[depth > far] = np.nan
        return CameraReading(time_ns=snapshot.time_ns, rgb=picture.rgb, depth=depth)

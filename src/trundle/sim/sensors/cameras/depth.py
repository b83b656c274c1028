"""Depth cameras."""

import math

import numpy as np

from trundle.robots.model import Noise
from trundle.sim.render import add_depth_noise, clip_depths
from trundle.sim.simulation import Snapshot

from .camera import CameraReading, CameraSensor


class DepthCameraSensor(CameraSensor):
    """Camera for registered color and depth images, as Gazebo's depth camera."""

    needs_depth = True

    def measure(self, snapshot: Snapshot) -> CameraReading:
        """Render both images; depths out of range are NaN, as in gazebo_ros' openni plugin."""
        picture = self.render(snapshot)
        assert picture.depth is not None
        noise = self.optics.noise
        near = -math.inf if self.optics.depth_near_m is None else self.optics.depth_near_m
        far = math.inf if self.optics.depth_far_m is None else self.optics.depth_far_m
        depth = np.ascontiguousarray(picture.depth)
        if noise != Noise():
            add_depth_noise(depth, seed=self.noise_seed(), mean=noise.mean, stddev=noise.stddev)
        clip_depths(depth, near_m=near, far_m=far, out=depth)
        return CameraReading(time_ns=snapshot.time_ns, rgb=picture.rgb, depth=depth)

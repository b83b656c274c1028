"""Thermal cameras: how warm what they see is."""

import numpy as np

from trundle.simulation import Snapshot

from .camera import CameraReading, CameraSensor


class ThermalCameraSensor(CameraSensor):
    """Sees the temperatures that gz's Thermal plugin gave visuals; all else is as warm as the air."""

    needs_segmentation = True

    def measure(self, snapshot: Snapshot) -> CameraReading:
        """See how warm it is; for the eye the coldest thing is black and the warmest white."""
        shapes = self.render(snapshot).segmentation
        assert shapes is not None
        known = self.scene.temperatures
        span = max(float(known.max() - known.min()), 1.0)
        grey = ((known - known.min()) / span * 255.0).astype(np.uint8)[shapes]
        rgb = np.repeat(grey[..., None], 3, axis=-1)
        return CameraReading(time_ns=snapshot.time_ns, rgb=rgb, temperatures=known[shapes])

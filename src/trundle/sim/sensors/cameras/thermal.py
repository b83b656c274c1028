"""Thermal cameras: a temperature per pixel."""

import numpy as np

from trundle.sim.simulation import Snapshot

from .camera import CameraReading, CameraSensor


class ThermalCameraSensor(CameraSensor):
    """Camera for the temperatures of gz's Thermal plugin; other shapes have the air's temperature."""

    needs_segmentation = True

    def measure(self, snapshot: Snapshot) -> CameraReading:
        """Render the temperatures; the color image maps the coldest to black and the warmest to white."""
        shapes = self.render(snapshot).segmentation
        assert shapes is not None
        temperatures = self.scene.temperatures
        span = max(float(temperatures.max() - temperatures.min()), 1.0)
        grey = ((temperatures - temperatures.min()) / span * 255.0).astype(np.uint8)[shapes]
        rgb = np.repeat(grey[..., None], 3, axis=-1)
        return CameraReading(time_ns=snapshot.time_ns, rgb=rgb, temperatures=temperatures[shapes])

"""Observations of sensors: lidar ranges and camera pictures."""

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from trundle.sim.sensors import CameraHandle, NoiseSource, RangeSensor
from trundle.spatial import pose_from_row

from .observations import Generators, ObservationReader
from .states import WorldStates


class LidarRanges:
    """Ranges of a lidar or ray sensor [m] with its noise, row by row, clipped to its limits."""

    def __init__(self, sensor: str) -> None:
        """Observe a sensor.

        Args:
            sensor: sensor's name, as in `trundle.load(…).sensor`.
        """
        self.sensor = sensor

    def reader(self, states: WorldStates, random: Generators) -> ObservationReader:
        """See `Observation`."""
        return _LidarReader(states.simulation.range_sensor(self.sensor), states, random)


class _LidarReader:
    def __init__(self, sensor: RangeSensor, states: WorldStates, random: Generators) -> None:
        self._sensor = sensor
        self._states = states
        self._random = random
        scan = sensor.scan
        self._noise = [NoiseSource(scan.noise, generator) for generator in random]
        size = scan.vertical.values * scan.horizontal.values
        self.space = spaces.Box(np.float32(scan.min_m), np.float32(scan.max_m), (size,), dtype=np.float32)

    def read(self) -> NDArray[np.float32]:
        """Return (rows, rays)."""
        rows = [self._read(row) for row in range(self._states.rows)]
        self._states.simulation.engine.reader.invalidate()
        return np.clip(np.stack(rows).astype(np.float32), self.space.low, self.space.high)

    def reset(self, row: int) -> None:
        """Draw the noise's bias."""
        self._noise[row] = NoiseSource(self._sensor.scan.noise, self._random[row])

    def _read(self, row: int) -> NDArray[np.float64]:
        simulation = self._states.show_links(row)
        link = pose_from_row(self._states.batch.poses[row, self._sensor.link_index])
        return self._sensor.measure_from(link, simulation.time_ns, self._noise[row]).ranges.ravel()


class CameraPicture:
    """Picture of a camera: (height, width, 3) uint8, with its lens and without noise."""

    def __init__(self, camera: str) -> None:
        """Observe a camera.

        Args:
            camera: camera's name, as in `trundle.load(…).camera`.
        """
        self.camera = camera

    def reader(self, states: WorldStates, random: Generators) -> ObservationReader:
        """See `Observation`."""
        del random
        return _CameraReader(states.simulation.camera(self.camera), states)


class _CameraReader:
    def __init__(self, camera: CameraHandle, states: WorldStates) -> None:
        self._camera = camera
        self._states = states
        width, height = camera.size
        self.space = spaces.Box(0, 255, (height, width, 3), dtype=np.uint8)

    def read(self) -> NDArray[np.uint8]:
        """Return (rows, height, width, 3)."""
        return np.stack([self._read(row) for row in range(self._states.rows)])

    def reset(self, row: int) -> None:
        """Do nothing."""

    def _read(self, row: int) -> NDArray[np.uint8]:
        self._states.show(row)
        return self._camera.render().rgb

"""librotors_gazebo_imu_plugin.so: an imu with noise and bias drift."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation, Snapshot
from trundle.spatial import Vector3

from ..gazebo_ros.link_motion import LinkMotion
from ..gazebo_ros.ros_plugin import RosPlugin
from .namespaces import read_topic_name


@dataclass(slots=True)
class _NoiseModel:
    """Noise of three axes: white noise, a Gauss-Markov bias, and a turn-on bias."""

    random: np.random.Generator
    density: float
    """Noise density [unit/√Hz]."""
    walk: float
    """Bias random walk."""
    correlation_s: float
    """Correlation time of the bias [s]."""
    bias: NDArray[np.float64]
    """(3,) Gauss-Markov bias."""
    first: NDArray[np.float64]
    """(3,) Turn-on bias."""

    def with_noise(self, values: Vector3, dt: float) -> dict[str, float]:
        """Return the values with noise, `dt` [s] after the last ones."""
        spread = self.walk * math.sqrt(self.correlation_s / 2.0 * -math.expm1(-2.0 * dt / self.correlation_s))
        self.bias = math.exp(-dt / self.correlation_s) * self.bias + spread * self.random.normal(size=3)
        noise = self.density / math.sqrt(dt) * self.random.normal(size=3)
        return dict(zip("xyz", (np.array(values) + self.bias + noise + self.first).tolist(), strict=True))

    @property
    def covariance(self) -> list[float]:
        """Row-major 3×3 covariance of the noise."""
        return [self.density**2 if number % 4 == 0 else 0.0 for number in range(9)]


class Imu(RosPlugin):
    """Publishes sensor_msgs/Imu at every step; the orientation is true, with covariance −1 ("unknown") as in RotorS.

    Parameters, with RotorS' defaults, an ADIS16448's: <robotNamespace>, <linkName> (required), <imuTopic> imu,
    <gyroscopeNoiseDensity>, <gyroscopeBiasRandomWalk>, <gyroscopeBiasCorrelationTime> 1000, <gyroscopeTurnOnBiasSigma>,
    <accelerometerNoiseDensity> 0.004, <accelerometerRandomWalk> 0.006, <accelerometerBiasCorrelationTime> 300,
    <accelerometerTurnOnBiasSigma> 0.196.
    """

    def __init__(self, sim: Simulation, model: ModelHandle, node: Node, parameters: TagParameters) -> None:
        super().__init__(sim, model, node, parameters)
        link = model.link(parameters.text("linkName"))
        self._frame, self._motion = link.name, LinkMotion(link)
        self._gravity = sim.world.physics.gravity
        random = np.random.default_rng(sim.seed)
        degree = math.pi / 180.0
        walks = ("gyroscopeBiasRandomWalk", "accelerometerRandomWalk")
        defaults = ((70.0 / 3600 * degree, 8.0 / 3600 * degree, 1000.0, 0.5 * degree), (0.004, 0.006, 300.0, 0.196))
        self._gyroscope, self._accelerometer = (
            _read_noise_model(parameters, random, walk, values) for walk, values in zip(walks, defaults, strict=True)
        )
        self._topic = node.advertise(read_topic_name(parameters, "imuTopic", "imu"), "sensor_msgs/Imu", queue_size=1)
        self._last_ns = sim.time_ns

    def after_step(self, snapshot: Snapshot) -> None:
        """Publish the reading."""
        if not self._topic.has_subscribers:
            return
        elapsed, self._last_ns = (snapshot.time_ns - self._last_ns) / 1e9, snapshot.time_ns
        motion = self._motion.sample(snapshot.time_ns)
        if elapsed <= 0.0:
            return
        (ax, ay, az), (gx, gy, gz) = motion.acceleration, motion.in_link(self._gravity)
        qw, qx, qy, qz = motion.orientation
        self._topic.publish(
            {
                "header": {"stamp": snapshot.time_ns, "frame_id": self._frame},
                "orientation": {"x": qx, "y": qy, "z": qz, "w": qw},
                "orientation_covariance": [-1.0] * 9,
                "angular_velocity": self._gyroscope.with_noise(motion.rate, elapsed),
                "angular_velocity_covariance": self._gyroscope.covariance,
                "linear_acceleration": self._accelerometer.with_noise((ax - gx, ay - gy, az - gz), elapsed),
                "linear_acceleration_covariance": self._accelerometer.covariance,
            }
        )


def _read_noise_model(
    parameters: TagParameters, random: np.random.Generator, walk: str, defaults: tuple[float, ...]
) -> _NoiseModel:
    """Read the noise model whose parameters have the prefix of `walk`, a …RandomWalk parameter."""
    sensor = walk.removesuffix("RandomWalk").removesuffix("Bias")
    names = (f"{sensor}NoiseDensity", walk, f"{sensor}BiasCorrelationTime", f"{sensor}TurnOnBiasSigma")
    bounds = (-math.inf, -math.inf, 0.0, -math.inf)
    density, spread, correlation_s, sigma = (
        parameters.number(name, value, above=bound) for name, value, bound in zip(names, defaults, bounds, strict=True)
    )
    return _NoiseModel(random, density, spread, correlation_s, np.zeros(3), sigma * random.normal(size=3))

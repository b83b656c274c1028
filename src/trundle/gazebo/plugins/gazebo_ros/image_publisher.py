"""Images of a color camera as image_transport publishes them: raw, and compressed below the topic."""

from collections.abc import Callable
from functools import lru_cache

from trundle.ros.bridge import compressed_image
from trundle.sim.sensors import CameraReading

from .plugin_names import PluginNames
from .sensor_publisher import SensorPublisher


class ImagePublisher:
    """sensor_msgs/Image on a topic, and sensor_msgs/CompressedImage on TOPIC/compressed, each where it is heard."""

    def __init__(
        self,
        names: PluginNames,
        topic: str,
        frame: str,
        image: Callable[[CameraReading], dict[str, object]],
        *,
        rate_hz: float = 0.0,
        is_compressible: bool,
    ) -> None:
        """Advertise.

        Args:
            names: names of the plugin.
            topic: of the raw images.
            frame: of the headers.
            image: makes a message of a reading.
            rate_hz: greatest rate [Hz]; 0: the sensor's.
            is_compressible: the images' encoding is one that `compressed_image` takes.
        """
        self._image = lru_cache(maxsize=1)(image)
        self._raw = SensorPublisher(names.advertise("sensor_msgs/Image", topic), frame, rate_hz=rate_hz)
        self._compressed: SensorPublisher | None = None
        if is_compressible:
            compressed = names.advertise("sensor_msgs/CompressedImage", f"{topic}/compressed")
            self._compressed = SensorPublisher(compressed, frame, rate_hz=rate_hz)

    def has_subscribers(self) -> bool:
        """True if there is a subscriber of either."""
        return self._raw.has_subscribers() or (self._compressed is not None and self._compressed.has_subscribers())

    def publish(self, reading: CameraReading) -> None:
        """Publish a reading as what is subscribed to."""
        self._raw.publish(reading, lambda: self._image(reading))
        if self._compressed is not None:
            self._compressed.publish(reading, lambda: compressed_image(self._image(reading)))

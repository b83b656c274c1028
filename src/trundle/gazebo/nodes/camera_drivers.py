"""usb_cam, cv_camera and gscam: images of this machine's camera, or of a video file."""

import asyncio
import os
import re
import stat
import sys
import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar
from urllib.parse import unquote, urlsplit

import numpy as np
import yaml
from numpy.typing import NDArray

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.base.files import read_file
from trundle.base.yaml_loader import load_yaml
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node

from .host import NodeHost
from .private_parameters import private_parameters
from .rate import Rate

_DEVICE = re.compile(r"\bv4l2src\b[^!]*?\bdevice=\"?([^\s\"!]+)")
_LOCATION = re.compile(r"\bfilesrc\b[^!]*?\blocation=\"?([^\s\"!]+)")
_DEFAULT_SOURCE = re.compile(r"\b(?:v4l2src|autovideosrc|avfvideosrc|ksvideosrc)\b")
_SIZES = {"D": None, "K": 9, "R": 9, "P": 12}
_YAML_NAMES = {
    "D": "distortion_coefficients", "K": "camera_matrix", "R": "rectification_matrix", "P": "projection_matrix",
}  # fmt: skip


class _Video:
    """Images of a camera or a file, decoded by PyAV on a worker thread."""

    def __init__(self, source: str, *, size: tuple[int, int] | None, rate_hz: float | None) -> None:
        """Open.

        Args:
            source: path of a device or file.
            size: width and height requested from a camera [px]; None: camera's default.
            rate_hz: frame rate requested from a camera; for a file, replaces its frame rate.

        Raises:
            UsageError: PyAV is not installed, or the source cannot be opened.
        """
        try:
            import av
            from av.error import FFmpegError
        except ModuleNotFoundError:
            raise UsageError("images need PyAV: pip install av") from None
        self.is_camera = not os.path.isfile(source)
        options, kind = {"protocol_whitelist": "file"}, None
        name = f"file:{source}"
        if self.is_camera:
            kind, name = _capture(source)
            options = {} if size is None else {"video_size": f"{size[0]}x{size[1]}"}
            options |= {} if rate_hz is None else {"framerate": f"{rate_hz:g}"}
        try:
            self._container = av.open(name, format=kind, options=options)
            self._stream = self._container.streams.video[0]
        except (FFmpegError, OSError, IndexError) as error:
            reason = getattr(error, "strerror", None) or "it has no images"
            raise UsageError(f"cannot open {source}: {reason}; the path of a video file can replace it") from None
        self.rate_hz = rate_hz or float(self._stream.average_rate or 30)
        self._frames = self._container.decode(self._stream)
        self._lock = threading.Lock()
        """Held while an image is read: closing the container at that time crashes the process."""
        self._is_closed = False
        self._errors = FFmpegError

    def next(self, encoding: str) -> NDArray[np.uint8] | None:
        """Return the next image (height, width, channels); None at the end of a file, or without the camera."""
        with self._lock:
            if self._is_closed:
                return None
            try:
                frame = next(self._frames, None)
            except (self._errors, OSError):
                return None
        return None if frame is None else np.ascontiguousarray(frame.to_ndarray(format=_FORMATS[encoding]), np.uint8)

    def close(self) -> None:
        """Close, once no image is being read."""
        with self._lock:
            self._is_closed = True
            self._container.close()


_FORMATS = {"rgb8": "rgb24", "bgr8": "bgr24", "mono8": "gray"}
"""Encoding of an Image → pixel format of FFmpeg."""


def _capture(source: str) -> tuple[str, str]:
    """Return FFmpeg's device kind and name for a camera.

    Raises:
        UsageError: no such camera.
    """
    if sys.platform == "darwin":
        return "avfoundation", re.sub(r"\D", "", source) or "0"
    if sys.platform == "win32":
        raise UsageError(f"{source}: cameras are not read on Windows; the path of a video file can replace them")
    try:
        is_device = stat.S_ISCHR(os.stat(source).st_mode)
    except OSError:
        is_device = False
    if not is_device:
        raise UsageError(f"no camera {source}; the path of a video file can replace it")
    return "v4l2", source


class CameraDriver:
    """Publishes an image topic and its camera_info until the images end."""

    topic: ClassVar[str] = "~image_raw"
    info_topic: ClassVar[str] = "~camera_info"

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self.source = ""
        self.size: tuple[int, int] | None = None
        self.rate_hz: float | None = None
        self.encoding = "rgb8"
        self.frame = "camera"
        self.repeats = True
        """True if a file restarts at its end."""

    def read(self, settings: RosParameters) -> None:
        """Read the driver's parameters.

        Raises:
            ParamError: a parameter is missing or invalid.
        """
        raise NotImplementedError

    async def run(self) -> int:
        """Publish until cancelled, or the images end."""
        node = self._node
        settings = await private_parameters(node)
        try:
            self.read(settings)
            if self.encoding not in _FORMATS:
                raise ParamError(f"no encoding {self.encoding!r}; encodings: {', '.join(_FORMATS)}")
            info = _read_calibration(settings.text("camera_info_url", ""), node)
            video = await asyncio.to_thread(_Video, self.source, size=self.size, rate_hz=self.rate_hz)
        except TrundleError as error:
            node.log.fatal(str(error))
            return 1
        images = node.advertise(self.topic, "sensor_msgs/Image", queue_size=1)
        infos = node.advertise(self.info_topic, "sensor_msgs/CameraInfo", queue_size=1)
        rate = Rate(node, video.rate_hz)
        try:
            while not node.closed.is_set():
                image = await asyncio.to_thread(video.next, self.encoding)
                if image is None:
                    if video.is_camera or not self.repeats:
                        node.log.error(f"{self.source} has no more images")
                        return 1 if video.is_camera else 0
                    await asyncio.to_thread(video.close)
                    video = await asyncio.to_thread(_Video, self.source, size=self.size, rate_hz=self.rate_hz)
                    continue
                header = {"stamp": node.clock.now_ns(), "frame_id": self.frame}
                height, width = image.shape[:2]
                images.publish(
                    {
                        "header": header, "height": height, "width": width, "encoding": self.encoding,
                        "step": image.strides[0], "data": image.tobytes(),
                    }
                )  # fmt: skip
                infos.publish({"header": header, "height": height, "width": width, **info})
                if not video.is_camera:
                    await rate.sleep()
            return 0
        finally:
            asyncio.get_running_loop().run_in_executor(None, video.close)


class UsbCam(CameraDriver):
    """usb_cam/usb_cam_node.

    Parameters, with the original's defaults: video_device /dev/video0 (or a video file), image_width 640, image_height
    480, framerate 30, camera_frame_id head_camera, camera_info_url; the others set up the device and have no effect.
    """

    def read(self, settings: RosParameters) -> None:
        """See `CameraDriver.read`."""
        self.source = settings.text("video_device", "/dev/video0")
        self.size = (settings.integer("image_width", 640, minimum=1), settings.integer("image_height", 480, minimum=1))
        self.rate_hz = settings.number("framerate", 30.0, above=0.0)
        self.frame = settings.text("camera_frame_id", "head_camera")


class CvCamera(CameraDriver):
    """cv_camera/cv_camera_node.

    Parameters, with the original's defaults: file (a video; the node ends with it), else device_path, else device_id
    0; rate 30, frame_id camera, image_width and image_height (the camera's), camera_info_url.
    """

    def read(self, settings: RosParameters) -> None:
        """See `CameraDriver.read`."""
        device = settings.text("device_path", "") or f"/dev/video{settings.integer('device_id', 0, minimum=0)}"
        self.source = settings.text("file", "") or device
        width, height = (settings.integer(f"image_{side}", 0, minimum=0) for side in ("width", "height"))
        self.size = (width, height) if width and height else None
        self.rate_hz = settings.number("rate", 30.0, above=0.0)
        self.frame = settings.text("frame_id", "camera")
        self.encoding, self.repeats = "bgr8", False


class GsCam(CameraDriver):
    """gscam/gscam: the source device or file of a GStreamer pipeline; its other elements are ignored.

    Parameters, with the original's defaults: gscam_config (else the variable GSCAM_CONFIG), frame_id camera_frame,
    image_encoding rgb8 (or mono8), reopen_on_eof false, camera_info_url.
    """

    topic = "camera/image_raw"
    info_topic = "camera/camera_info"

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        super().__init__(node, arguments, host)
        self._environment: Mapping[str, str] = {**os.environ, **host.env}

    def read(self, settings: RosParameters) -> None:
        """See `CameraDriver.read`."""
        pipeline = settings.text("gscam_config", "") or self._environment.get("GSCAM_CONFIG", "")
        if not pipeline:
            raise ParamError(f"{settings.namespace}: neither gscam_config nor the variable GSCAM_CONFIG is set")
        match = _DEVICE.search(pipeline) or _LOCATION.search(pipeline)
        if match is None and not _DEFAULT_SOURCE.search(pipeline):
            supported = "v4l2src device=… and filesrc location=… are supported"
            raise ParamError(f"{settings.namespace}: the source of the pipeline {pipeline!r} is unknown; {supported}")
        self.source = "/dev/video0" if match is None else match[1]
        self.frame = settings.text("frame_id", "camera_frame").lstrip("/")
        self.encoding = settings.text("image_encoding", "rgb8")
        self.repeats = settings.flag("reopen_on_eof", default=False)


def _read_calibration(url: str, node: Node) -> dict[str, Any]:
    """Return the CameraInfo fields in a camera_calibration YAML; if it is missing, warn and return none."""
    parts = urlsplit(url)
    if not url:
        return {}
    if parts.scheme not in ("", "file"):
        node.log.warn(f"camera_info_url {url!r} is not read; use a file:// URL")
        return {}
    path = Path(unquote(parts.path))
    try:
        content: Any = load_yaml(read_file(path).decode())
        fields: dict[str, Any] = {"distortion_model": str(content["distortion_model"])}
        for field, name in _YAML_NAMES.items():
            values = [float(value) for value in content[name]["data"]]
            if _SIZES[field] not in (None, len(values)):
                raise ValueError(f"{name} has {len(values)} numbers")
            fields[field] = values
    except (OSError, yaml.YAMLError, KeyError, TypeError, ValueError) as error:
        node.log.warn(f"camera calibration {path} is not used: {error}")
        return {}
    return fields

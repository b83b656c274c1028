"""Conversion of image messages to arrays and back."""

import sys
from typing import TYPE_CHECKING, Any

import numpy as np
from sensor_msgs.msg import CompressedImage, Image

from . import compressed
from .color import ConversionError, convert_color
from .encodings import cv_type, element_type, from_cv_type, generic_encoding

if TYPE_CHECKING:
    from numpy.typing import NDArray


class CvBridgeError(TypeError):
    """An image that cannot be converted."""


class CvBridge:
    """Converts between sensor_msgs images and OpenCV's arrays."""

    def dtype_with_channels_to_cvtype2(self, dtype: "np.dtype[Any]", n_channels: int) -> str:
        """Encoding of an array without color meaning, such as `8UC3`."""
        return generic_encoding(dtype.name, n_channels)

    def cvtype2_to_dtype_with_channels(self, cvtype: int) -> tuple[str, int]:
        """Numpy type's name and channels of OpenCV's type number."""
        return from_cv_type(cvtype)

    def encoding_to_cvtype2(self, encoding: str) -> int:
        """OpenCV's type number of an encoding."""
        return cv_type(*self.encoding_to_dtype_with_channels(encoding))

    def encoding_to_dtype_with_channels(self, encoding: str) -> tuple[str, int]:
        """Numpy type's name and channels of an encoding.

        Raises:
            CvBridgeError: no such encoding.
        """
        elements = element_type(encoding)
        if elements is None:
            raise CvBridgeError(f"Unrecognized image encoding [{encoding}]")
        return elements

    def imgmsg_to_cv2(self, img_msg: Any, desired_encoding: str = "passthrough") -> "NDArray[Any]":
        """Array of an Image message, (height, width) or (height, width, channels).

        Args:
            img_msg: sensor_msgs Image; with `passthrough` the array shares its memory.
            desired_encoding: encoding to convert to.

        Raises:
            CvBridgeError: no such encoding, no such conversion, or the data is too short.
        """
        name, channels = self.encoding_to_dtype_with_channels(img_msg.encoding)
        dtype = np.dtype(name).newbyteorder(">" if img_msg.is_bigendian else "<")
        pixel = dtype.itemsize * channels
        step = img_msg.step or img_msg.width * pixel
        shape = (img_msg.height, img_msg.width) if channels == 1 else (img_msg.height, img_msg.width, channels)
        strides = (step, pixel) if channels == 1 else (step, pixel, dtype.itemsize)
        try:
            image = np.ndarray(shape, dtype, buffer=img_msg.data, strides=strides)
        except (TypeError, ValueError) as error:
            raise CvBridgeError(
                f"{img_msg.width}x{img_msg.height} {img_msg.encoding} with step {step} does not fit "
                f"{len(img_msg.data)} bytes: {error}"
            ) from None
        if img_msg.is_bigendian == (sys.byteorder == "little"):
            image = image.astype(name)
        return image if desired_encoding == "passthrough" else self._convert(image, img_msg.encoding, desired_encoding)

    def compressed_imgmsg_to_cv2(self, cmprs_img_msg: Any, desired_encoding: str = "passthrough") -> "NDArray[Any]":
        """Array of a CompressedImage message; colors are BGR, unless `desired_encoding` differs.

        Raises:
            CvBridgeError: invalid data, or no such conversion.
        """
        try:
            image = compressed.decode(cmprs_img_msg.data)
        except ValueError as error:
            raise CvBridgeError(str(error)) from None
        if desired_encoding == "passthrough":
            return image
        channels = 1 if image.ndim == 2 else image.shape[2]
        source = {1: "mono", 3: "bgr", 4: "bgra"}[channels] + ("16" if image.dtype == np.uint16 else "8")
        return self._convert(image, source, desired_encoding)

    def cv2_to_imgmsg(self, cvim: Any, encoding: str = "passthrough", header: Any = None) -> Any:
        """Image message of an array.

        Args:
            cvim: (height, width) or (height, width, channels).
            encoding: array's encoding; `passthrough`: an encoding without color meaning, such as `8UC3`.
            header: message's header.

        Raises:
            TypeError: not an array.
            CvBridgeError: the array does not fit the encoding.
        """
        if not isinstance(cvim, np.ndarray | np.generic):
            raise TypeError(f"cv2_to_imgmsg needs a numpy array, not {type(cvim).__name__}")
        image: NDArray[Any] = np.asarray(cvim)
        message = Image(height=image.shape[0], width=image.shape[1])
        if header is not None:
            message.header = header
        channels = 1 if image.ndim < 3 else image.shape[2]
        actual = self.dtype_with_channels_to_cvtype2(image.dtype, channels)
        if encoding != "passthrough" and generic_encoding(*self.encoding_to_dtype_with_channels(encoding)) != actual:
            raise CvBridgeError(f"encoding specified as {encoding}, but image has incompatible type {actual}")
        message.encoding = actual if encoding == "passthrough" else encoding
        message.is_bigendian = image.dtype.byteorder == ">"
        message.data = image.tobytes()
        message.step = len(message.data) // message.height if message.height else 0
        return message

    def cv2_to_compressed_imgmsg(self, cvim: Any, dst_format: str = "jpg") -> Any:
        """CompressedImage message of an array in BGR order.

        Raises:
            TypeError: not an array.
            CvBridgeError: the format is unknown, or cannot hold such an image.
        """
        if not isinstance(cvim, np.ndarray | np.generic):
            raise TypeError(f"cv2_to_compressed_imgmsg needs a numpy array, not {type(cvim).__name__}")
        try:
            return CompressedImage(format=dst_format, data=compressed.encode(np.asarray(cvim), dst_format))
        except ValueError as error:
            raise CvBridgeError(str(error)) from None

    def _convert(self, image: "NDArray[Any]", source: str, target: str) -> "NDArray[Any]":
        try:
            return convert_color(image, source, target)
        except ConversionError as error:
            raise CvBridgeError(str(error)) from None

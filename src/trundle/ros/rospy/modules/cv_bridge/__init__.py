"""Image messages as numpy arrays, the images of OpenCV."""

from .bridge import CvBridge, CvBridgeError
from .display import cvtColorForDisplay

__all__ = ["CvBridge", "CvBridgeError", "cvtColorForDisplay", "getCvType"]


def getCvType(encoding: str) -> int:
    """OpenCV's type number of an encoding.

    Raises:
        CvBridgeError: no such encoding.
    """
    return CvBridge().encoding_to_cvtype2(encoding)

"""`cv_bridge.bridge`, under its old name."""

from .bridge import CvBridge, CvBridgeError

__all__ = ["CvBridge", "CvBridgeError"]

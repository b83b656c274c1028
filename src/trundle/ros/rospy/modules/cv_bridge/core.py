"""`cv_bridge.bridge`, by its old name."""

from .bridge import CvBridge, CvBridgeError

__all__ = ["CvBridge", "CvBridgeError"]

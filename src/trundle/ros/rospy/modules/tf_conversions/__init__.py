"""Conversions of poses between messages, tf, matrices and KDL frames."""

from tf import transformations

from .posemath import fromCameraParams, fromMatrix, fromMsg, fromTf, toMatrix, toMsg, toTf

__all__ = ["fromCameraParams", "fromMatrix", "fromMsg", "fromTf", "toMatrix", "toMsg", "toTf", "transformations"]

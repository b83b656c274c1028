"""Drive laws and what controllers share."""

from .drive import DifferentialDrive, WheelOdometry, approach

__all__ = ["DifferentialDrive", "WheelOdometry", "approach"]

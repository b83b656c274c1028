"""Drive laws and what controllers share."""

from .drive import DifferentialDrive, WheelOdometry, approach
from .pid import Pid

__all__ = ["DifferentialDrive", "Pid", "WheelOdometry", "approach"]

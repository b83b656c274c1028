"""Odometry from scans alone: laser_scan_matcher, rf2o_laser_odometry."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

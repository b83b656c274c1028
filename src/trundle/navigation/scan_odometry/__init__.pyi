from .laser_scan_matcher import LaserScanMatcher as LaserScanMatcher
from .rf2o import Rf2oLaserOdometry as Rf2oLaserOdometry

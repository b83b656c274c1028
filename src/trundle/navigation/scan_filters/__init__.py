"""Filters and mergers of scans: laser_filters, ira_laser_tools."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

"""Goals one after the other: follow_waypoints, yocs_waypoints_navi, yocs_waypoint_provider."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

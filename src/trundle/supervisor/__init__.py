"""Processes and tasks: started, watched over, respawned, stopped; no ROS in here."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

"""arbotix_python's driver in its simulated mode."""

from .driver import ArbotixDriver

__all__ = ["ArbotixDriver"]

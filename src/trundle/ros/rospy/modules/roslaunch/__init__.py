"""Launching from programs, by `trundle launch` and `trundle exec`."""

from . import config as config
from . import core as core
from . import parent as parent
from . import rlutil as rlutil
from . import scriptapi as scriptapi
from . import substitution_args as substitution_args
from . import xmlloader as xmlloader
from .core import DEFAULT_MASTER_PORT, Master, Node, Process, RLException
from .parent import ROSLaunchParent as ROSLaunchParent
from .scriptapi import ROSLaunch

NAME = "roslaunch"
__all__ = ["DEFAULT_MASTER_PORT", "NAME", "Master", "Node", "Process", "RLException", "ROSLaunch", "configure_logging"]


def configure_logging(uuid: str) -> None:
    """Nothing to set up: launches log by themselves."""
    del uuid

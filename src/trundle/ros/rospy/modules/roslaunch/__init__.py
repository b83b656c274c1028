"""Launching from programs, by `trundle launch` and `trundle exec`."""

from . import (
    config as config,
    core as core,
    parent as parent,
    rlutil as rlutil,
    scriptapi as scriptapi,
    substitution_args as substitution_args,
    xmlloader as xmlloader,
)
from .core import DEFAULT_MASTER_PORT, Master, Node, Process, RLException
from .parent import ROSLaunchParent as ROSLaunchParent
from .scriptapi import ROSLaunch

NAME = "roslaunch"
__all__ = ["DEFAULT_MASTER_PORT", "NAME", "Master", "Node", "Process", "RLException", "ROSLaunch", "configure_logging"]


def configure_logging(uuid: str) -> None:
    """Do nothing: launches configure their logs themselves."""
    del uuid

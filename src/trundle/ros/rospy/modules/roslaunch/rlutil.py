"""Identifiers and files of launches."""

import os
import uuid
from collections.abc import Sequence
from typing import Any

import rosgraph

from .core import RLException


def get_or_generate_uuid(options_runid: str | None, options_wait_for_master: bool) -> str:
    """Identifier of the graph's run, or a new one."""
    del options_wait_for_master
    if options_runid:
        return options_runid
    try:
        return str(rosgraph.Master("/roslaunch").getParam("/run_id"))
    except (OSError, rosgraph.MasterException):
        return str(uuid.uuid1())


def resolve_launch_arguments(args: Sequence[str]) -> list[str]:
    """Path of the launch file on a command line: FILE, or PACKAGE FILE.

    Raises:
        RLException: no such launch file.
    """
    from roslib.packages import InvalidROSPkgException, find_resource

    names = [argument for argument in args if ":=" not in argument]
    if len(names) == 1 and os.path.isfile(names[0]):
        return [os.path.abspath(names[0])]
    if len(names) < 2:
        raise RLException(f"[{' '.join(names)}] is not a launch file name")
    try:
        paths = find_resource(names[0], names[1])
    except InvalidROSPkgException as error:
        raise RLException(f"[{names[0]}] is not a package: {error}") from None
    if not paths:
        raise RLException(f"[{names[1]}] is neither a launch file in package [{names[0]}] nor is [{names[0]}] one")
    return paths[:1]


def check_roslaunch(f: str, use_test_depends: bool = False, ignore_unset_args: bool = False) -> Any:
    """Faults of a launch file; None if there is none."""
    del use_test_depends, ignore_unset_args
    return None if os.path.isfile(f) else f"no such file {f}"

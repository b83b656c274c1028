"""Classes of messages and services by name."""

import importlib
from typing import Any

from .rostime import Duration, Time


def get_message_class(message_type: str, reload_on_error: bool = False) -> Any:
    """Class of a message type ('std_msgs/String'); None if there is none.

    Raises:
        ValueError: the name has no package.
    """
    del reload_on_error
    if message_type in ("time", "duration"):
        return Time if message_type == "time" else Duration
    return _find(message_type, "msg")


def get_service_class(service_type: str, reload_on_error: bool = False) -> Any:
    """Class of a service type; None if there is none.

    Raises:
        ValueError: the name has no package.
    """
    del reload_on_error
    return _find(service_type, "srv")


def _find(type_name: str, kind: str) -> Any:
    package, _, name = type_name.rpartition("/")
    package = package.removesuffix(f"/{kind}")
    if not package:
        if name != "Header":
            raise ValueError(f"message type is missing package name: {type_name}")
        package = "std_msgs"
    try:
        return getattr(importlib.import_module(f"{package}.{kind}"), name, None)
    except ImportError:
        return None

"""Parameters of running nodes that other nodes may change."""

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this module's
if TYPE_CHECKING:
    from collections.abc import KeysView
    from typing import Any


class DynamicReconfigureException(Exception):
    """Base class of this package's exceptions."""


class DynamicReconfigureParameterException(DynamicReconfigureException):
    """A parameter that does not exist, or a value that does not fit."""


class DynamicReconfigureCallbackException(DynamicReconfigureException):
    """The server's callback failed."""


def find_reconfigure_services() -> list[str]:
    """Names of all nodes (with namespace) that can be reconfigured."""
    import rosservice

    ending = "/set_parameters"
    return sorted(name.removesuffix(ending) for name in rosservice.get_service_list() if name.endswith(ending))


def get_parameter_names(descr: "Any") -> "KeysView[str]":
    """Names of the parameters of an XConfig module."""
    return descr.defaults.keys()

"""Parameters of running nodes that others may change."""


class DynamicReconfigureException(Exception):
    """Base of this package's errors."""


class DynamicReconfigureParameterException(DynamicReconfigureException):
    """A parameter that does not exist, or a value that does not fit."""


class DynamicReconfigureCallbackException(DynamicReconfigureException):
    """The server's callback failed."""


def find_reconfigure_services():
    """Names of all nodes (with namespace) that can be reconfigured."""
    import rosservice

    ending = "/set_parameters"
    return sorted(name.removesuffix(ending) for name in rosservice.get_service_list() if name.endswith(ending))


def get_parameter_names(descr):
    """Names of the parameters of an XConfig module."""
    return descr.defaults.keys()

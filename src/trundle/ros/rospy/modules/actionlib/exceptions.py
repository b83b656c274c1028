"""Exception of this package."""


class ActionException(Exception):
    """A type that is not an action, or a wrong use of one."""

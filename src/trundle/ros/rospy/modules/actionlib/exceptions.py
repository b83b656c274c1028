"""Exception of this package."""


class ActionException(Exception):
    """A type that is not an action, or an invalid use of an action."""

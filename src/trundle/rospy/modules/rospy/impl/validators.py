"""Exception of invalid parameters of remote calls."""


class ParameterInvalid(Exception):
    """A parameter is invalid."""

    def __init__(self, message: str) -> None:
        super().__init__(message)
        self._message = message

"""Constants and exceptions."""

import sys

SEP = "/"
EXT_MSG, EXT_SRV = ".msg", ".srv"
COMMENTCHAR, CONSTCHAR, IODELIM = "#", "=", "---"
_verbose = False


class InvalidMsgSpec(Exception):
    """A definition cannot be parsed."""


class MsgGenerationException(Exception):
    """Code cannot be generated."""


def log_verbose(value: bool) -> None:
    """Switch the output of `log` on or off."""
    global _verbose
    _verbose = value


def log(*args: object) -> None:
    """Print, if verbose."""
    if _verbose:
        print(*args, file=sys.stdout)

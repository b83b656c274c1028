"""The error of this room."""

from trundle.diagnostics import TrundleError


class ViewerError(TrundleError):
    """The page cannot be served: its process did not start, or died before it answered."""

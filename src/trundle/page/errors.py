"""Errors of the page."""

from trundle.base.diagnostics import TrundleError


class PageError(TrundleError):
    """The page cannot be served: its process did not start, or died before it answered."""

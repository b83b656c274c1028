"""Python's search for garbage, put off where there is none: what is loaded and read stays."""

import gc
from collections.abc import Generator
from contextlib import contextmanager

_SELDOM = 200_000
"""Objects between two searches: more than modules and an honest file make."""


@contextmanager
def no_garbage() -> Generator[None]:
    """Search seldom, and never again among what is there at the end."""
    before = gc.get_threshold()
    gc.set_threshold(_SELDOM)
    try:
        yield
    finally:
        gc.set_threshold(*before)
        gc.freeze()

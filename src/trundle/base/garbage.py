"""Garbage collection, reduced while loading."""

import gc
from collections.abc import Generator
from contextlib import contextmanager

_THRESHOLD = 200_000
"""Allocations until a collection: more than importing modules and reading ordinary files make."""


@contextmanager
def no_garbage() -> Generator[None]:
    """Collect rarely, and freeze the objects that exist at the end."""
    thresholds = gc.get_threshold()
    gc.set_threshold(_THRESHOLD)
    try:
        yield
    finally:
        gc.set_threshold(*thresholds)
        gc.freeze()

"""Garbage collection, reduced while loading."""

import gc
from collections.abc import Generator
from contextlib import contextmanager

_SELDOM = 200_000
"""Threshold of allocations, above those of modules and ordinary files."""


@contextmanager
def no_garbage() -> Generator[None]:
    """Collect rarely, and freeze the objects that exist at the end."""
    before = gc.get_threshold()
    gc.set_threshold(_SELDOM)
    try:
        yield
    finally:
        gc.set_threshold(*before)
        gc.freeze()

"""Garbage collection is reduced, then restored."""

import gc

from trundle.base.garbage import no_garbage


def test_no_collection_runs_and_new_objects_are_frozen() -> None:
    collections: list[int] = []

    def record(phase: str, info: dict[str, int]) -> None:
        collections.append(info["generation"])

    thresholds = gc.get_threshold()
    gc.callbacks.append(record)
    try:
        with no_garbage():
            objects = [[number] for number in range(10_000)]
    finally:
        gc.callbacks.remove(record)
        frozen = gc.get_freeze_count()
        gc.unfreeze()

    assert collections == []
    assert frozen >= len(objects)
    assert gc.get_threshold() == thresholds

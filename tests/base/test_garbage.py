"""Garbage collection paused and resumed."""

import gc

from trundle.base.garbage import no_garbage


def test_nothing_is_searched_while_things_are_made_nor_are_they_later() -> None:
    searches: list[int] = []

    def note(phase: str, info: dict[str, int]) -> None:
        searches.append(info["generation"])

    usual = gc.get_threshold()
    gc.callbacks.append(note)
    try:
        with no_garbage():
            made = [[each] for each in range(10_000)]
    finally:
        gc.callbacks.remove(note)
        kept = gc.get_freeze_count()
        gc.unfreeze()

    assert searches == []
    assert kept >= len(made)
    assert gc.get_threshold() == usual

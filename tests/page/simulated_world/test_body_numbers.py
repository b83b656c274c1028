"""Body numbers while models are added and removed."""

import numpy as np

from trundle.page.simulated_world.body_numbers import BodyNumbers


def poses(*x: float) -> np.ndarray:
    rows = np.zeros((len(x), 7))
    rows[:, 0], rows[:, 3] = x, 1.0
    return rows


def test_links_are_numbered_in_order() -> None:
    bodies = BodyNumbers()
    bodies.update(["a::l", "b::l"])

    assert (bodies["a::l"], bodies["b::l"]) == (0, 1)
    assert bodies.rows(poses(5.0, 6.0))[:, 0].tolist() == [5.0, 6.0]


def test_a_number_stays_when_an_earlier_model_is_deleted() -> None:
    bodies = BodyNumbers()
    bodies.update(["a::l", "b::l"])
    bodies.rows(poses(5.0, 6.0))

    bodies.update(["b::l"])

    assert bodies["b::l"] == 1
    assert bodies.rows(poses(7.0))[:, 0].tolist() == [5.0, 7.0]


def test_a_freed_number_is_reused_only_after_another_change() -> None:
    bodies = BodyNumbers()
    bodies.update(["a::l", "b::l"])
    bodies.update(["b::l"])
    bodies.update(["b::l", "c::l"])
    assert bodies["c::l"] == 2

    bodies.update(["b::l", "c::l", "d::l"])

    assert bodies["d::l"] == 0
    assert bodies.rows(poses(1.0, 2.0, 3.0))[:, 0].tolist() == [3.0, 1.0, 2.0]

"""The scene that is checked, asked for by several threads."""

import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest
from tests.planning.arms import arm

from trundle.planning.move_group.scene import SceneContents, SceneMirror, SceneObject
from trundle.planning.planning_scene import AllowedCollisionMatrix, PlacedShape
from trundle.robots.model import Box
from trundle.spatial import Pose


@pytest.fixture
def eager_threads() -> Iterator[None]:
    """Switch threads as often as possible."""
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(interval)


def test_threads_that_ask_for_different_scenes_get_their_own(eager_threads: None) -> None:
    """A pick plans in a thread with its object allowed, while others ask for the scene as it is."""
    log: Any = None
    model = arm("six_axis")
    mirror = SceneMirror(log, model, None)
    matrix = AllowedCollisionMatrix.of_model(model)

    def names(which: str) -> bool:
        contents = SceneContents(which, matrix)
        wanted = {f"{which} {number}" for number in range(6)}
        for name in wanted:
            shape = PlacedShape(Box((0.1, 0.1, 0.1)))
            contents.objects[name] = SceneObject(id=name, pose=Pose((1.0, 0.0, 0.0)), shapes=(shape,))
        return set(mirror.scene(contents, model.default_positions()).objects) == wanted

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(names, ["pick", "world"] * 100))

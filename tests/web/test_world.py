"""The simulated world on the page: models are added, removed, moved, hidden, selected, or unreadable."""

import struct
from base64 import b64encode
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.web.conftest import WorldPage

from trundle.robots.model import Box
from trundle.sim.gltf import Document, add_scene
from trundle.sim.render import Scene, Shape

_RED, _BLUE, _GREEN = (255, 0, 0), (0, 0, 255), (0, 255, 0)
_SCENE = {"ambient": [1, 1, 1], "background": [0, 0, 0], "sky": False, "shadows": False, "grid": False, "fog": None}


def _write(path: Path, name: str, body: int, color: tuple[int, int, int], y: float) -> None:
    """Write a model of one glowing cube of 1 m."""
    red, green, blue = (part / 255 for part in color)
    black = (0.0, 0.0, 0.0, 1.0)
    cube = Shape(name="cube", body=0, geometry=Box((1, 1, 1)), rgba=black, emissive=(red, green, blue, 1.0))
    document = Document(embed=True)
    scene = Scene(bodies=(f"{name}::link",), shapes=(cube,))
    path.write_bytes(document.glb(add_scene(document, scene, np.array([[0, y, 0, 1, 0, 0, 0]]), [body])))


def _show(page: WorldPage, *files: str, generation: int = 1, collisions: str | None = None) -> None:
    page.show_manifest(
        generation=generation,
        files=[{"id": file, "url": f"world/{file}.glb"} for file in files],
        scene=_SCENE,
        collisions=collisions,
    )
    page.page.wait_for_function("world.progress.value === 1")
    page.look((-6.0, 0.0, 0.0), yaw=0.0, pitch=0.0, vertical_fov=0.8)


def _move(page: WorldPage, body: int, position: tuple[float, float, float], *, generation: int) -> None:
    message = struct.pack("<QII I 7f", 1, generation, 1, body, *position, 0.0, 0.0, 0.0, 1.0)
    view = "new DataView(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer)"
    page.page.evaluate(f"(text) => connection.receiveRaw('trundle/poses', {view})", b64encode(message).decode())


def _columns(picture: NDArray[np.uint8], color: tuple[int, int, int]) -> tuple[int, int] | None:
    """Return the first and last column that has a color."""
    columns = np.flatnonzero((picture == np.array(color)).all(axis=-1).any(axis=0))
    return (int(columns[0]), int(columns[-1])) if columns.size else None


@pytest.fixture
def cubes(world_page: WorldPage, tmp_path: Path) -> WorldPage:
    """A red cube on the left, body 3, and a blue one on the right, body 8."""
    _write(tmp_path / "red.glb", "red", 3, _RED, 1.5)
    _write(tmp_path / "blue.glb", "blue", 8, _BLUE, -1.5)
    return world_page


def test_models_are_added_moved_and_removed(cubes: WorldPage) -> None:
    """Poses move bodies; a new generation removes models that it no longer names."""
    _show(cubes, "red", "blue")
    picture = cubes.picture()
    red, blue = _columns(picture, _RED), _columns(picture, _BLUE)
    assert red is not None
    assert blue is not None
    assert red[1] < 240 < blue[0]

    _move(cubes, 3, (0.0, -1.5, 0.0), generation=1)
    _move(cubes, 8, (0.0, 1.5, 0.0), generation=1)
    _move(cubes, 8, (0.0, 0.0, 9.0), generation=7)
    picture = cubes.picture()
    assert (_columns(picture, _BLUE), _columns(picture, _RED)) == (red, blue)

    _show(cubes, "red", generation=2)
    picture = cubes.picture()
    assert _columns(picture, _BLUE) is None
    assert _columns(picture, _RED) == blue
    assert cubes.page.evaluate("world.object(8)") is None


def test_a_hidden_model_is_not_drawn_and_a_selected_one_has_an_outline(cubes: WorldPage) -> None:
    """The outline is outside of the selected link, 2 px wide."""
    _show(cubes, "red", "blue")
    cubes.page.evaluate("world.hidden.value = new Set(['red'])")
    plain = cubes.picture()
    assert _columns(plain, _RED) is None
    cubes.page.evaluate("outlined.value = [{ thin: [], broad: [8], color: '--accent' }]")
    outlined = cubes.picture()
    first, last = _columns(plain, _BLUE) or (0, 0)
    row = outlined[180].astype(int)
    lit = np.flatnonzero(row.sum(axis=-1) > 60)
    assert (lit[0], lit[-1]) == (first - 2, last + 2)
    assert _columns(outlined, _BLUE) == (first, last)
    cubes.page.evaluate("outlined.value = []")
    assert (cubes.picture() == plain).all()


def test_collisions_move_with_their_bodies(cubes: WorldPage, tmp_path: Path) -> None:
    """They are fetched when they are shown."""
    _write(tmp_path / "collisions.glb", "red", 3, _GREEN, 0.0)
    _show(cubes, "red", collisions="world/collisions.glb")
    assert _columns(cubes.picture(), _GREEN) is None
    cubes.page.evaluate("world.shown.setAll('visuals', false)")
    cubes.page.evaluate("world.shown.setAll('collisions', true)")
    cubes.page.wait_for_function("world.object(3).children.length > 1")
    left = _columns(cubes.picture(), _GREEN)
    assert left is not None
    assert left[1] < 240
    _move(cubes, 3, (0.0, -1.5, 0.0), generation=1)
    right = _columns(cubes.picture(), _GREEN)
    assert right is not None
    assert right[0] > 240
    cubes.page.evaluate("world.shown.setAll('collisions', false)")
    assert _columns(cubes.picture(), _GREEN) is None


def test_an_unreadable_file_is_named_and_the_others_are_shown(cubes: WorldPage, tmp_path: Path) -> None:
    """The notice names the model and the reason."""
    (tmp_path / "odd.glb").write_bytes(b"no glTF")
    _show(cubes, "odd", "blue")
    [fault] = cubes.page.evaluate("world.faults.value")
    assert fault.startswith("odd is not shown: ")
    assert _columns(cubes.picture(), _BLUE) is not None

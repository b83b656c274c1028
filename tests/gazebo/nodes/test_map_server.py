"""Map files become occupancy grids by map_server's rules, and back."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from tests.gazebo.nodes.conftest import PATIENCE_S

from trundle.base.diagnostics import UsageError
from trundle.gazebo.nodes.map_server.occupancy_grid import read_cells, read_map

_KEYS = "resolution: 0.05\norigin: [-1.0, -2.0, 0.5]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"


@pytest.fixture
def picture(tmp_path: Path) -> Path:
    """Black, grey and white above; white below."""
    Image.fromarray(np.array([[0, 205, 255], [254, 254, 254]], dtype=np.uint8)).save(tmp_path / "map.pgm")
    return tmp_path / "map.yaml"


def test_black_is_occupied_white_free_and_grey_unknown(picture: Path) -> None:
    picture.write_text(f"image: map.pgm\n{_KEYS}")
    grid = read_map(picture)

    assert grid.cells.tolist() == [[0, 0, 0], [100, -1, 0]]  # the bottom row comes first
    assert (grid.resolution_m, grid.origin) == (0.05, (-1.0, -2.0, 0.5))


def test_negated_maps_and_modes(picture: Path) -> None:
    picture.write_text(f"image: map.pgm\n{_KEYS.replace('negate: 0', 'negate: 1')}")
    assert read_map(picture).cells.tolist() == [[100, 100, 100], [0, 100, 100]]

    picture.write_text(f"image: map.pgm\nmode: scale\n{_KEYS}")
    # Occupancy 50/255 of a scale from 0.196 to 0.65: just above free.
    assert read_map(picture).cells.tolist() == [[0, 0, 0], [100, 1, 0]]

    picture.write_text(f"image: map.pgm\nmode: raw\n{_KEYS}")
    assert read_map(picture).cells.tolist() == [[-2, -2, -2], [0, -51, -1]]  # shades as signed bytes


def test_a_truncated_image_is_rejected(tmp_path: Path) -> None:
    """Pillow's decoders raise exceptions of any type."""
    (tmp_path / "map.pgm").write_bytes(b"P5")
    with pytest.raises(UsageError, match=r"map\.pgm: Reached EOF"):
        read_cells(tmp_path / "map.pgm", negate=False, occupied=0.65, free=0.196)


@pytest.mark.parametrize(
    ("image", "reason"),
    [
        (b"P5\n100000 100000\n255\n", "exceeds limit"),
        (b"P5\n12000 12000\n255\n", "exceed the limit of 100000000 for maps"),
        (b"P5\n-1 5\n255\n", "it is not an image"),
        (b"P5\n10 10\n255\nabc", "truncated"),
        (b"P5\n" + 10_000 * b"9" + b" 1\n255\n", "Token too long"),
    ],
)
def test_a_hostile_image_is_rejected(picture: Path, image: bytes, reason: str) -> None:
    picture.with_name("map.pgm").write_bytes(image)
    picture.write_text(f"image: map.pgm\n{_KEYS}")
    with pytest.raises(UsageError, match=reason):
        read_map(picture)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("image: map.pgm\n", "the key 'origin' is missing"),
        ("[1]", "not a YAML mapping"),
        ("a: [", "expected"),
        (f"image: none.pgm\n{_KEYS}", "none.pgm"),
        (f"image: map.yaml\n{_KEYS}", "map.yaml: it is not an image"),
        (f"image: map.pgm\n{_KEYS.replace('0.05', '0')}", "resolution must be > 0"),
        (f"image: map.pgm\nmode: other\n{_KEYS}", "no mode 'other'"),
        (f"image: map.pgm\n{_KEYS.replace('[-1.0, -2.0, 0.5]', 'x')}", "origin: 'x' is not 3 numbers"),
        (f"image: map.pgm\n{_KEYS.replace('-1.0', '.nan')}", "origin: nan is not a finite number"),
        (f"image: map.pgm\n{_KEYS.replace('-1.0', '.inf')}", "origin: inf is not a finite number"),
        (f"image: map.pgm\n{_KEYS.replace('0.05', '1' + 400 * '0')}", r"resolution: 1000.*\.\.\. is not a number"),
        (f"image: map.pgm\n{_KEYS.replace('0.65', '.nan')}", "occupied_thresh: nan is not a finite number"),
        (f"image: map.pgm\nmode: scale\n{_KEYS.replace('0.65', '0.196')}", "free_thresh must be < occupied_thresh"),
        ("[" * 3000, "nested too deeply"),
        (f"image: /dev/zero\n{_KEYS}", "it is a device"),
        (f"image: [1]\n{_KEYS}", r"image: \[1\] is not a text"),
    ],
)
def test_an_invalid_map_is_rejected(picture: Path, text: str, reason: str) -> None:
    picture.write_text(text)
    with pytest.raises(UsageError, match=f".*{reason}"):
        read_map(picture)


def test_a_saved_map_equals_the_served_one(graph, picture: Path) -> None:
    picture.write_text(f"image: map.pgm\n{_KEYS}")
    graph.start("map_server/map_server", str(picture))
    saved = picture.with_name("saved")
    assert graph.start("map_server/map_saver", f"-f {saved}").result(PATIENCE_S) == 0

    pixels = bytes([254, 254, 254]), bytes([0, 205, 254])
    header = b"P5\n# CREATOR: map_saver.cpp 0.050 m/pix\n3 2\n255\n"
    assert saved.with_name("saved.pgm").read_bytes() == header + pixels[1] + pixels[0]
    assert read_map(saved.with_name("saved.yaml")).cells.tolist() == [[0, 0, 0], [100, -1, 0]]
    served = graph.call("/static_map", "nav_msgs/GetMap").map
    assert (served.header.frame_id, served.info.width, served.info.height) == ("map", 3, 2)
    assert served.info.origin.position.y == -2.0
    assert list(served.data) == [0, 0, 0, 100, -1, 0]


@pytest.mark.parametrize(
    ("info", "reason"),
    [
        ({"width": 7, "height": 3, "resolution": 0.05}, "announces 7 × 3 cells, and has 2"),
        ({"width": 2, "height": 1, "origin": {"position": {"x": float("nan")}}}, "is not finite"),
    ],
)
def test_a_hostile_map_is_not_saved(graph, tmp_path: Path, capsys, info: dict[str, object], reason: str) -> None:
    graph.client.advertise("/map", "nav_msgs/OccupancyGrid", latch=True).publish({"info": info, "data": [0, 0]})
    assert graph.start("map_server/map_saver", f"-f {tmp_path}/saved").result(PATIENCE_S) == 1
    assert reason in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_an_image_and_its_resolution_are_a_map(graph, picture: Path, capsys) -> None:
    image = picture.with_name("map.pgm")
    running = graph.start("map_server/map_server", f"{image} 0.1", negate=1)
    served = graph.call("/static_map", "nav_msgs/GetMap").map
    assert (served.info.resolution, served.info.origin.position.x) == (pytest.approx(0.1), 0.0)
    assert list(served.data) == [100, 100, 100, 0, 100, 100]
    assert not running.done()

    assert graph.start("map_server/map_server", f"{image} wide", name="other").result(PATIENCE_S) == 255
    assert "resolution must be a number [m], got 'wide'" in capsys.readouterr().err


def test_a_missing_map_ends_the_server(graph, capsys) -> None:
    assert graph.start("map_server/map_server", "/no/map.yaml").result(PATIENCE_S) == 255
    assert "/no/map.yaml" in capsys.readouterr().err

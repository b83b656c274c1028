"""Files with false counts, deep nesting or many instances end in one sentence; so do truncated files."""

import json
import struct
from pathlib import Path

import numpy as np
import pytest
import trimesh
from PIL import Image

from trundle.robots.meshes import MeshError, load_mesh, mean_color, read_heights

from .exporting import exported
from .test_parts import MTL, OBJ, collada


def stl(count: int, corners: np.ndarray) -> bytes:
    body = b"".join(struct.pack("<12fH", 0, 0, 1, *triangle.ravel(), 0) for triangle in corners)
    return b"solid but binary".ljust(80) + struct.pack("<I", count) + body


TRIANGLE = np.array([[[0, 0, 0], [1, 0, 0], [0, 1, 0]]], dtype=np.float32)


def refused(path: Path) -> str:
    with pytest.raises(MeshError) as caught:
        load_mesh(path)
    messages = str(caught.value)
    assert messages.startswith(f"{path}: ")
    assert "\n" not in messages
    return messages


def test_a_binary_stl_may_start_with_solid(tmp_path: Path) -> None:
    path = tmp_path / "a.stl"
    path.write_bytes(stl(1, TRIANGLE))
    assert load_mesh(path).vertices.shape == (3, 3)


def test_an_stl_that_declares_more_triangles_than_it_contains_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.stl"
    path.write_bytes(b"x" + stl(4_000_000_000, TRIANGLE)[1:])
    assert "declares 4000000000 triangles and contains 1" in refused(path)


def test_a_signalling_nan_is_refused_as_any_other(tmp_path: Path) -> None:
    """Casts of one make numpy warn."""
    path = tmp_path / "a.stl"
    whole = stl(1, TRIANGLE)
    path.write_bytes(whole[:-26] + bytes.fromhex("0100807f") + whole[-22:])  # x of the second corner
    assert "vertex 2 is at nan 0 0, which is not within" in refused(path)


@pytest.mark.parametrize("height", [np.nan, np.inf])
def test_heights_that_are_not_finite_are_refused(tmp_path: Path, height: float) -> None:
    Image.fromarray(np.full((9, 9), height, dtype=np.float32)).save(tmp_path / "h.tif")
    with pytest.raises(MeshError, match="heights that are not finite"):
        read_heights(tmp_path / "h.tif")


def test_an_image_that_pillow_warns_of_is_decoded_without_a_warning(tmp_path: Path) -> None:
    path = tmp_path / "a.jpg"
    exif = Image.Exif()
    exif[0x010F] = "maker's name, which is long"
    Image.new("RGB", (8, 8), (255, 0, 0)).save(path, exif=exif)
    path.write_bytes(path.read_bytes().replace(b"\0\0\0\x1c", b"\x7f\0\0\x1c", 1))  # the length of that name

    assert mean_color(path) == pytest.approx((1.0, 0.0, 0.0, 1.0), abs=0.02)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_an_stl_with_values_that_are_not_finite_is_refused(tmp_path: Path, value: float) -> None:
    path = tmp_path / "a.stl"
    path.write_bytes(stl(1, np.where(TRIANGLE == 1, np.float32(value), TRIANGLE)))
    assert "not within" in refused(path)


@pytest.mark.slow
def test_collada_nodes_that_multiply(tmp_path: Path) -> None:
    """Ten levels of ten instances each would be ten thousand million quads."""
    path = collada(tmp_path / "a.dae")
    quad = '<instance_geometry url="#quad-mesh"/>'
    levels = (f'<node id="x{i}">' + f'<instance_node url="#x{i - 1}"/>' * 10 + "</node>" for i in range(1, 11))
    library = [f'<node id="x0">{quad}</node>', *levels]
    text = path.read_text()
    scenes = "<library_visual_scenes>"
    text = text.replace(scenes, f"<library_nodes>{''.join(library)}</library_nodes>{scenes}")
    path.write_text(text.replace('<node id="n1"', '<node id="n0"><instance_node url="#x10"/></node><node id="n1"'))
    assert "too many of them" in refused(path)


def test_a_collada_polygon_of_a_thousand_million_corners(tmp_path: Path) -> None:
    path = collada(tmp_path / "a.dae")
    path.write_text(path.read_text().replace("<vcount>4<", "<vcount>1000000000<"))
    refused(path)


def test_collada_entities_that_multiply_or_read_files(tmp_path: Path) -> None:
    path = collada(tmp_path / "a.dae")
    text = path.read_text().split("\n", 1)[1]
    laughs = "".join(f'<!ENTITY l{i} "{f"&l{i - 1};" * 10}">' for i in range(1, 12))
    laughing = text.replace(">0 0 0 100", ">&l11; 0 0 0 100")
    path.write_text(f'<!DOCTYPE a [<!ENTITY l0 "1 1 1 1 1">{laughs}]>{laughing}')
    refused(path)
    prying = text.replace(">0 0 0 100", ">&x; 0 0 0 100")
    path.write_text(f'<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]>{prying}')
    refused(path)


def test_a_zip_that_calls_itself_collada(tmp_path: Path) -> None:
    path = tmp_path / "a.dae"
    path.write_bytes(b"PK\x03\x04" + b"\0" * 100)
    assert "unpack it" in refused(path)


def glb(tree: dict[str, object]) -> bytes:
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", 4, b"BIN\0") + b"\0" * 4
    return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def test_a_glb_that_declares_more_than_it_contains_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "a.glb"
    path.write_bytes(glb({"asset": {"version": "2.0"}, "accessors": [{"count": 10**12, "type": "VEC3"}]}))
    assert "declares more vertices than it has bytes" in refused(path)
    path.write_bytes(glb({"asset": {"version": "2.0"}, "buffers": [{"uri": "/etc/passwd", "byteLength": 4}]}))
    assert "in another file" in refused(path)


@pytest.mark.parametrize("suffix", [".dae", ".obj", ".stl", ".glb"])
def test_a_file_cut_anywhere_is_read_or_refused_in_a_sentence(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    if suffix == ".dae":
        whole = collada(path).read_bytes()
    elif suffix == ".obj":
        whole = OBJ.encode()
        (tmp_path / "car.mtl").write_text(MTL)
    else:
        whole = exported(trimesh.creation.box(), suffix[1:])
    messages: list[str] = []
    for cut in range(0, len(whole), max(1, len(whole) // 40)):
        path.write_bytes(whole[:cut])
        try:
            load_mesh(path)
        except MeshError as error:
            messages.append(str(error))
    assert messages
    assert not any("\n" in message for message in messages)

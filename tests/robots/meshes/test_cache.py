"""The cache on disk: used, invisible, bounded, and harmless when damaged or impossible."""

import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh
import trimesh.visual
from numpy.typing import NDArray
from PIL import Image

from trundle.robots.meshes import Mesh, cache, load, load_mesh

from .exporting import exported


@pytest.fixture
def large(tmp_path: Path) -> Path:
    """A ball in color, large enough to be kept."""
    ball = trimesh.creation.icosphere(subdivisions=5)
    path = tmp_path / "ball.obj"
    path.write_bytes(b"mtllib ball.mtl\nusemtl red\n" + exported(ball, "obj", include_normals=False))
    (tmp_path / "ball.mtl").write_text("newmtl red\nKd 1 0 0\n")
    return path


@pytest.fixture
def painted(tmp_path: Path) -> Path:
    """A ball in one file with its image."""
    ball = trimesh.creation.icosphere(subdivisions=5)
    image = Image.effect_noise((32, 32), 64)
    material = trimesh.visual.material.PBRMaterial(baseColorTexture=image, baseColorFactor=(0.2, 0.4, 0.6, 1.0))
    ball.visual = trimesh.visual.TextureVisuals(uv=np.asarray(ball.vertices)[:, :2], material=material)
    path = tmp_path / "ball.glb"
    path.write_bytes(exported(trimesh.Scene(ball), "glb"))
    return path


def read_again(path: Path) -> Mesh:
    """Load, bypassing the cache in memory."""
    load._load.cache_clear()
    return load_mesh(path)


def same(a: Mesh, b: Mesh) -> bool:
    arrays = ((a.vertices, b.vertices), (a.faces, b.faces), (a.uv, b.uv))
    return all(_same_array(x, y) for x, y in arrays) and a.parts == b.parts


def _same_array(a: NDArray[Any] | None, b: NDArray[Any] | None) -> bool:
    return a is b if a is None or b is None else np.array_equal(a, b)


def test_the_cached_mesh_equals_the_one_read(large: Path, cache_folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = read_again(large)
    (entry,) = cache_folder.iterdir()
    assert entry.suffix == ".npz"

    monkeypatch.setattr(load, "_read", lambda *_: pytest.fail("read again"))
    assert same(read_again(large), first)
    large.rename(large.with_name("other.obj"))
    assert same(read_again(large.with_name("other.obj")), first)


def test_an_image_inside_is_kept_with_its_uv(
    painted: Path, cache_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = read_again(painted)
    assert isinstance(first.parts[0].texture, bytes)
    assert first.uv is not None
    assert len(list(cache_folder.iterdir())) == 1

    monkeypatch.setattr(load, "_read", lambda *_: pytest.fail("read again"))
    assert same(read_again(painted), first)


def test_another_content_is_another_entry(large: Path, cache_folder: Path) -> None:
    assert read_again(large).rgba == (1.0, 0.0, 0.0, 1.0)

    large.with_suffix(".mtl").write_text("newmtl red\nKd 0 1 0\n")

    assert read_again(large).rgba == (0.0, 1.0, 0.0, 1.0)
    assert len(list(cache_folder.iterdir())) == 2


def test_a_file_that_changes_is_read_again_within_a_process(tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert len(load_mesh(path).faces) == 1
    path.write_text(path.read_text() + "f 3 2 1\n")
    assert len(load_mesh(path).faces) == 2


@pytest.mark.parametrize("spoil", ["cut", "bit", "text", "empty"])
def test_a_damaged_entry_is_thrown_away(large: Path, cache_folder: Path, spoil: str) -> None:
    first = read_again(large)
    (entry,) = cache_folder.iterdir()
    data = bytearray(entry.read_bytes())
    data[len(data) // 2] ^= 0x40
    entry.write_bytes({"cut": data[: len(data) // 2], "bit": data, "text": b"hello", "empty": b""}[spoil])

    assert same(read_again(large), first)
    assert entry.read_bytes() != data


def test_a_cache_that_cannot_be_written_is_no_error(
    large: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    blocked = tmp_path / "a_file"
    blocked.write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(blocked))
    assert len(read_again(large).faces) == 20480


def test_the_least_recently_used_entries_are_removed_first(
    large: Path, cache_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    parts = load._read(large.read_bytes(), ".obj", large)
    size = len(cache._packed(parts))
    monkeypatch.setattr(cache, "_MAX_BYTES", 8 * size)
    for number in range(12):
        cache.save_parts(f"key{number:02}", parts)
        os.utime(cache_folder / f"key{number:02}.npz", (number, number))
    assert sorted(path.stem for path in cache_folder.iterdir()) == [f"key{number:02}" for number in range(4, 12)]
    assert cache.load_parts("key00") is None
    assert cache.load_parts("key11") is not None
    assert not list(cache_folder.glob("*.tmp"))


@pytest.mark.parametrize("has_moved", [False, True])
def test_an_interrupted_save_leaves_no_partial_file(
    has_moved: bool, large: Path, cache_folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    move = os.replace

    def interrupt(source: str, target: Path) -> None:
        if has_moved:
            move(source, target)
        raise KeyboardInterrupt

    parts = load._read(large.read_bytes(), ".obj", large)
    monkeypatch.setattr(os, "replace", interrupt)
    with pytest.raises(KeyboardInterrupt):
        cache.save_parts("key", parts)
    assert [path.name for path in cache_folder.iterdir()] == (["key.npz"] if has_moved else [])

"""Hostile archives and names: nothing is written outside of the folder, and refusals have a reason."""

import os
import stat
import struct
from pathlib import Path
from zipfile import ZIP_BZIP2, ZIP_DEFLATED, ZipFile, ZipInfo

import pytest

from trundle.base.diagnostics import UsageError
from trundle.page.uploads.archive import unpack
from trundle.page.uploads.model import find_models
from trundle.page.uploads.tree import UploadTree


def _tree(tmp_path: Path, *, max_bytes: int = 10_000_000) -> UploadTree:
    (tmp_path / "in").mkdir()
    return UploadTree(tmp_path / "in", max_bytes=max_bytes)


def _zip(tmp_path: Path, *entries: tuple[str | ZipInfo, bytes], method: int = ZIP_DEFLATED) -> Path:
    with ZipFile(tmp_path / "cart.zip", "w", method) as packed:
        for name, content in entries:
            packed.writestr(name, content)
    return tmp_path / "cart.zip"


def test_hidden_files_are_not_unpacked(tmp_path: Path) -> None:
    tree = _tree(tmp_path)
    names = ["cart/model.sdf", "./cart/meshes/a wheel (1).dae", ".git/config", "cart/.DS_Store", "__MACOSX/cart/x"]
    unpack(_zip(tmp_path, *((name, name.encode()) for name in names)), tree)

    files = {path.relative_to(tree.root).as_posix() for path in tree.root.rglob("*") if path.is_file()}
    assert files == {"cart/model.sdf", "cart/meshes/a wheel (1).dae"}
    assert (tree.root / "cart/model.sdf").read_bytes() == b"cart/model.sdf"


@pytest.mark.parametrize(
    "name",
    [
        "../out.sdf", "cart/../../out.sdf", "/out.sdf", "//out.sdf", "cart//out.sdf", "..\\out.sdf", "C:out.sdf",
        "cart/nul", "COM1.sdf", "cart/out.sdf ", "cart./out.sdf", "out\n.sdf", "x" * 200, "a/" * 20 + "out.sdf",
        "cart/..",
    ],
)  # fmt: skip
def test_paths_out_of_the_folder_are_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(UsageError, match="is not a valid path in a model's folder"):
        unpack(_zip(tmp_path, (name, b"bad")), _tree(tmp_path))
    assert sorted(file.name for file in tmp_path.iterdir()) == ["cart.zip", "in"]
    assert list((tmp_path / "in").iterdir()) == []


@pytest.mark.parametrize("kind", [stat.S_IFLNK, stat.S_IFIFO, stat.S_IFCHR])
def test_a_link_or_a_device_is_refused(tmp_path: Path, kind: int) -> None:
    entry = ZipInfo("cart/model.sdf")
    entry.create_system, entry.external_attr = 3, (kind | 0o777) << 16
    with pytest.raises(UsageError, match="is not a regular file"):
        unpack(_zip(tmp_path, (entry, b"/etc/passwd")), _tree(tmp_path))


def test_unpacking_a_zip_bomb_stops_at_the_limit(tmp_path: Path) -> None:
    archive = _zip(tmp_path, ("cart/model.sdf", bytes(5_000_000)))
    claimed = archive.read_bytes().replace(struct.pack("<I", 5_000_000), struct.pack("<I", 10))
    tree = _tree(tmp_path, max_bytes=1_000_000)
    with pytest.raises(UsageError, match="it is too large"):
        unpack(archive, tree)
    assert sum(path.stat().st_size for path in tree.root.rglob("*") if path.is_file()) <= 1_000_000
    archive.write_bytes(claimed)
    tree = UploadTree(tmp_path / "again", max_bytes=1_000_000)
    with pytest.raises(UsageError, match=r"too large|cannot be unpacked"):
        unpack(archive, tree)


def test_too_many_files_are_refused_even_before_they_are_listed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("trundle.page.uploads.tree.MAX_FILES", 3)
    with pytest.raises(UsageError, match="more than 3 files"):
        unpack(_zip(tmp_path, *((f"{number}.sdf", b"") for number in range(4))), _tree(tmp_path))
    directory = os.urandom(5_000_000)
    end = struct.pack("<4s4H2LH", b"PK\5\6", 0, 0, 60_000, 60_000, len(directory), 0, 0)
    (tmp_path / "cart.zip").write_bytes(directory + end)
    with pytest.raises(UsageError, match="more than 2000 files"):
        unpack(tmp_path / "cart.zip", UploadTree(tmp_path / "in"))


def test_damaged_archives_are_refused_with_a_reason(tmp_path: Path) -> None:
    tree = _tree(tmp_path)
    with pytest.raises(UsageError, match="a method other than deflate"):
        unpack(_zip(tmp_path, ("model.sdf", b"x" * 100), method=ZIP_BZIP2), tree)
    with pytest.raises(UsageError, match=r"'Model\.sdf' is a duplicate file name"):
        unpack(_zip(tmp_path, ("model.sdf", b"x"), ("Model.sdf", b"y")), tree)
    (tmp_path / "cart.zip").write_bytes(b"no archive")
    with pytest.raises(UsageError, match="the archive cannot be unpacked"):
        unpack(tmp_path / "cart.zip", tree)


@pytest.mark.slow
def test_an_archive_with_any_byte_changed_is_unpacked_or_refused(tmp_path: Path) -> None:
    whole = _zip(tmp_path, ("cart/model.sdf", b"<sdf/>" * 20), ("cart/model.config", b"<model/>")).read_bytes()
    for index in range(len(whole)):
        for bit in (1, 128):
            folder = tmp_path / f"{index}.{bit}"
            folder.mkdir()
            changed = bytearray(whole)
            changed[index] ^= bit
            (tmp_path / "cart.zip").write_bytes(changed)
            try:
                unpack(tmp_path / "cart.zip", UploadTree(folder, max_bytes=100_000))
            except UsageError:
                continue
    assert {file.name for file in tmp_path.iterdir()} == {"cart.zip"} | {
        f"{i}.{b}" for i in range(len(whole)) for b in (1, 128)
    }


def _put(root: Path, *names: str) -> Path:
    for name in names:
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        (root / name).write_text("<sdf/>")
    return root


def test_models_are_the_folders_with_a_config(tmp_path: Path) -> None:
    root = _put(tmp_path, "models/cart/model.config", "models/wheel/model.config", "models/cart/old/model.config")
    assert find_models(root, "all") == {"cart": root / "models/cart", "wheel": root / "models/wheel"}
    assert find_models(_put(tmp_path, "model.config"), "cart") == {"cart": tmp_path}


@pytest.mark.parametrize(
    ("files", "name", "sdf"),
    [
        (["cart.sdf"], "sent", "cart.sdf"),
        (["cart_description/urdf/cart.urdf", "cart_description/meshes/w.dae"], "cart_description", "urdf/cart.urdf"),
    ],
)
def test_a_single_file_gets_a_config(tmp_path: Path, files: list[str], name: str, sdf: str) -> None:
    ((model, folder),) = find_models(_put(tmp_path, *files), "sent").items()
    assert model == name
    assert f"<sdf version='1.6'>{sdf}</sdf>" in (folder / "model.config").read_text()


def test_uploads_without_a_model_are_refused_with_a_reason(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"no model\.config, \.sdf or \.urdf in it"):
        find_models(_put(tmp_path, "readme.txt"), "x")
    with pytest.raises(UsageError, match=r"several files may be the model: a\.sdf, b\.urdf"):
        find_models(_put(tmp_path, "a.sdf", "b.urdf"), "x")


def test_encrypted_archives_are_refused(tmp_path: Path) -> None:
    data = bytearray(_zip(tmp_path, ("model.sdf", b"secret")).read_bytes())
    data[6] |= 1
    data[data.rindex(b"PK\1\2") + 8] |= 1
    (tmp_path / "cart.zip").write_bytes(data)
    with pytest.raises(UsageError, match="is encrypted"):
        unpack(tmp_path / "cart.zip", _tree(tmp_path))

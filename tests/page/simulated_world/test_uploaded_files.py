"""Uploaded models next to a saved file."""

import shutil
from pathlib import Path

import pytest

from trundle.base.diagnostics import Diagnostics
from trundle.page import SaveDraft
from trundle.page.model_editor.draft import Draft
from trundle.page.model_editor.reader import ModelReader
from trundle.page.requests.answers import SavedFile
from trundle.page.simulated_world.model_saver import save_draft
from trundle.page.simulated_world.uploaded_files import copies, needed_uploads, with_upload_uris
from trundle.robots.description import load
from trundle.robots.model import MeshFile
from trundle.robots.packages import Packages
from trundle.spatial import Pose


@pytest.fixture
def uploads(tmp_path: Path) -> Path:
    """Models `cart`, `wheel` and `lamp`; `cart` refers to files of `wheel`, no model to those of `lamp`."""
    for name, text in (("cart", "model://wheel/wheel.obj"), ("wheel", "model://cart/"), ("lamp", "")):
        (tmp_path / "uploads" / name).mkdir(parents=True)
        (tmp_path / "uploads" / name / "model.sdf").write_text(f"<sdf><uri>{text}</uri></sdf>")
    (tmp_path / "uploads" / "wheel" / "wheel.obj").write_text("v 0 0 0\n")
    return tmp_path / "uploads"


@pytest.fixture
def packages(tmp_path: Path, uploads: Path) -> Packages:
    packages = Packages({}, start=tmp_path)
    packages.add_models(uploads)
    return packages


@pytest.mark.parametrize("uri", ["model://cart", "model://cart/model.sdf", "package://cart/model.sdf"])
def test_needed_uploads_include_indirect_references(packages: Packages, uploads: Path, uri: str) -> None:
    needed = needed_uploads(f"<sdf><uri>{uri}</uri></sdf>".encode(), packages)

    assert needed == {name: uploads / name for name in ("cart", "wheel")}


def test_a_longer_model_name_is_no_reference(packages: Packages) -> None:
    assert needed_uploads(b"<uri>model://cart2/x.obj</uri><uri>model://lamps</uri>", packages) == {}


def test_file_uris_of_uploads_become_model_uris(packages: Packages, uploads: Path) -> None:
    text = f"<uri>file://{uploads}/wheel/wheel.obj</uri>".encode()

    assert with_upload_uris(text, packages) == b"<uri>model://wheel/wheel.obj</uri>"


def test_copies_are_in_folders_named_after_the_models(packages: Packages, uploads: Path, tmp_path: Path) -> None:
    files = copies(needed_uploads(b"<uri>model://wheel</uri>", packages), tmp_path / "worlds")

    assert files[tmp_path / "worlds/wheel/wheel.obj"] == uploads / "wheel/wheel.obj"
    assert {path.relative_to(tmp_path / "worlds").parts[0] for path in files} == {"cart", "wheel"}


def test_a_model_is_saved_with_its_uploaded_mesh(packages: Packages, uploads: Path, tmp_path: Path) -> None:
    """In any folder, its mesh is found after the uploads are removed."""
    cube = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)) + "f 1 2 4 3\nf 5 6 8 7\n"
    (uploads / "wheel" / "wheel.obj").write_text(cube)
    (uploads / "wheel" / "model.config").write_text("<model><name>w</name><sdf>model.sdf</sdf></model>")
    mesh = f"<geometry><mesh><uri>file://{uploads}/wheel/wheel.obj</uri></mesh></geometry>"
    model = f'<model name="m"><link name="l"><visual name="v">{mesh}</visual></link></model>'
    draft = Draft(
        f'<sdf version="1.7">{model}</sdf>'.encode(),
        ModelReader(packages, {}, tmp_path),
        original=None,
        world_from_model=Pose(),
    )
    for folder in ("models/mine", "wheel"):
        assert save_draft(draft, SaveDraft(folder=folder), tmp_path, packages) == SavedFile(file=folder)
    shutil.rmtree(uploads)

    for folder, meshes in (("models/mine", "models/wheel"), ("wheel", "wheel")):
        file, report = tmp_path / folder / "model.sdf", Diagnostics()
        (link,) = load(str(file), report, packages=Packages({}, start=file)).world.models[0].links
        assert report.warnings == []
        geometry = link.visuals[0].geometry
        assert isinstance(geometry, MeshFile)
        assert geometry.path == tmp_path / meshes / "wheel.obj"

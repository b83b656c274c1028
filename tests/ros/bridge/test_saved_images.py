"""Images of a camera's <save>: their folder, names and limits."""

from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from trundle.sim.render import NativeRenderer
from trundle.sim.sensors import mount_cameras

from .test_cameras import WALL, camera_robot

NAME = "w_bot_head_eye({})-000{}.jpg"


@pytest.fixture(autouse=True)
def _working_directory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def started(load_world: Any, path: str) -> Any:
    """Start a camera with a <path>."""
    sim = load_world(camera_robot("camera", inside=f'<save enabled="true"><path>{path}</path></save>') + WALL)
    (camera,) = mount_cameras(sim, NativeRenderer)
    camera.start(sim)
    return sim


def saved(load_world: Any, path: str) -> Any:
    """Save two images of a camera with a <path>, in 0.1 s."""
    sim = started(load_world, path)
    sim.run(0.1)
    return sim


@pytest.mark.parametrize(
    ("path", "folder"),
    [
        ("saved_images/shots", "saved_images/shots"),
        ("{here}/saved_images/shots", "saved_images/shots"),
        ("shots", "saved_images/shots"),
        ("../../shots", "saved_images{above}/shots"),
        ("/etc/shots", "saved_images/etc/shots"),
        ("saved_images/../../../etc", "saved_images{above}/etc"),
    ],
)
def test_images_are_saved_below_one_folder_with_gazebos_names(
    load_world: Any, tmp_path: Path, path: str, folder: str
) -> None:
    sim = saved(load_world, path.format(here=tmp_path))

    saved_folder = tmp_path / folder.format(above=tmp_path.parent.parent)
    assert sorted(file.name for file in saved_folder.iterdir()) == [NAME.format(1, i) for i in range(2)]
    with Image.open(saved_folder / NAME.format(1, 0)) as image:
        assert image.size == (64, 48)
    findings = [finding for finding in sim.report.findings if "<save> writes into" in finding.what]
    assert [finding.severity for finding in findings] == ["info" if "saved_images/shots" in path else "warning"]
    assert str(saved_folder) in findings[0].what


def test_existing_files_are_not_overwritten(load_world: Any, tmp_path: Path) -> None:
    first = tmp_path / "saved_images/shots" / NAME.format(1, 0)
    first.parent.mkdir(parents=True)
    first.symlink_to(tmp_path / "elsewhere")
    first.with_name(NAME.format(2, 0)).write_text("mine")

    sim = saved(load_world, "saved_images/shots")

    assert sim.report.warnings == []
    assert not (tmp_path / "elsewhere").exists()
    assert first.with_name(NAME.format(2, 0)).read_text() == "mine"
    assert first.with_name(NAME.format(3, 1)).is_file()


@pytest.mark.parametrize("link", ["saved_images", "saved_images/shots"])
def test_images_are_not_saved_through_a_link(load_world: Any, tmp_path: Path, link: str) -> None:
    outside = tmp_path.parent / f"{tmp_path.name}_outside"
    outside.mkdir()
    (tmp_path / link).parent.mkdir(exist_ok=True)
    (tmp_path / link).symlink_to(outside)

    sim = saved(load_world, "saved_images/shots")

    assert list(outside.iterdir()) == []
    assert f"a link in it leads out of {tmp_path}; saving stopped" in sim.report.warnings[0]


@pytest.mark.parametrize("bound", ["_MAX_IMAGES", "_MAX_BYTES"])
def test_saving_stops_at_its_limits_with_a_warning(
    load_world: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, bound: str
) -> None:
    monkeypatch.setattr(f"trundle.sim.sensors.cameras.image_saver.{bound}", 1)

    sim = saved(load_world, "saved_images/shots")

    assert len(list(tmp_path.rglob("*.jpg"))) == (1 if bound == "_MAX_IMAGES" else 0)
    (warning,) = sim.report.warnings
    assert warning.endswith("GiB are saved in a run; TRUNDLE_SAVE_ALL=1 lifts the limit")


def test_the_limit_can_be_disabled(load_world: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.sim.sensors.cameras.image_saver._MAX_IMAGES", 1)
    monkeypatch.setenv("TRUNDLE_SAVE_ALL", "1")

    assert saved(load_world, "saved_images/shots").report.warnings == []
    assert len(list(tmp_path.rglob("*.jpg"))) == 2


def test_saving_stops_with_a_warning_if_the_folder_cannot_be_created(load_world: Any, tmp_path: Path) -> None:
    (tmp_path / "saved_images").touch()

    (warning,) = saved(load_world, "saved_images/shots").report.warnings

    assert "Not a directory; saving stopped" in warning


def test_an_image_that_does_not_fit_on_the_disk_is_removed(load_world: Any, tmp_path: Path) -> None:
    resource = pytest.importorskip("resource", reason="this system does not limit file sizes")
    sim, previous = started(load_world, "saved_images/shots"), resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, previous[1]))
    try:
        sim.run(0.1)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, previous)

    (warning,) = sim.report.warnings
    assert "File too large; saving stopped" in warning
    assert list((tmp_path / "saved_images/shots").iterdir()) == []

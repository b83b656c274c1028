"""Images of a camera's <save>: their folder and number."""

from pathlib import Path
from typing import Any

import pytest
from PIL import Image

from trundle.sim.render import NativeRenderer
from trundle.sim.sensors import mount_cameras

from .test_cameras import WALL, eye

NAME = "w_bot_head_eye({})-000{}.jpg"


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:  # pyright: ignore[reportUnusedFunction]
    monkeypatch.chdir(tmp_path)


def started(described: Any, path: str) -> Any:
    """A camera with this <path>."""
    sim = described(eye("camera", inside=f'<save enabled="true"><path>{path}</path></save>') + WALL)
    (camera,) = mount_cameras(sim, NativeRenderer)
    camera.start(sim)
    return sim


def saved(described: Any, path: str) -> Any:
    """Two pictures, 0.1 s, of a camera with this <path>."""
    sim = started(described, path)
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
def test_they_go_below_one_folder_under_gazebo_s_names(described: Any, tmp_path: Path, path: str, folder: str) -> None:
    sim = saved(described, path.format(here=tmp_path))

    place = tmp_path / folder.format(above=tmp_path.parent.parent)
    assert sorted(each.name for each in place.iterdir()) == [NAME.format(1, i) for i in range(2)]
    with Image.open(place / NAME.format(1, 0)) as picture:
        assert picture.size == (64, 48)
    said = [each for each in sim.report.findings if "<save> writes into" in each.what]
    assert [each.severity for each in said] == ["info" if "saved_images/shots" in path else "warning"]
    assert str(place) in said[0].what


def test_a_file_that_is_there_is_not_written_over(described: Any, tmp_path: Path) -> None:
    first = tmp_path / "saved_images/shots" / NAME.format(1, 0)
    first.parent.mkdir(parents=True)
    first.symlink_to(tmp_path / "elsewhere")
    first.with_name(NAME.format(2, 0)).write_text("mine")

    sim = saved(described, "saved_images/shots")

    assert sim.report.warnings == []
    assert not (tmp_path / "elsewhere").exists()
    assert first.with_name(NAME.format(2, 0)).read_text() == "mine"
    assert first.with_name(NAME.format(3, 1)).is_file()


@pytest.mark.parametrize("link", ["saved_images", "saved_images/shots"])
def test_no_link_leads_them_elsewhere(described: Any, tmp_path: Path, link: str) -> None:
    outside = tmp_path.parent / f"{tmp_path.name}_outside"
    outside.mkdir()
    (tmp_path / link).parent.mkdir(exist_ok=True)
    (tmp_path / link).symlink_to(outside)

    sim = saved(described, "saved_images/shots")

    assert list(outside.iterdir()) == []
    assert f"a link in it leads out of {tmp_path}; saving stopped" in sim.report.warnings[0]


@pytest.mark.parametrize("bound", ["_MAX_IMAGES", "_MAX_BYTES"])
def test_they_end_with_a_sentence_where_they_are_too_many(
    described: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, bound: str
) -> None:
    monkeypatch.setattr(f"trundle.sim.sensors.cameras.image_saver.{bound}", 1)

    sim = saved(described, "saved_images/shots")

    assert len(list(tmp_path.rglob("*.jpg"))) == (1 if bound == "_MAX_IMAGES" else 0)
    (warning,) = sim.report.warnings
    assert warning.endswith("GiB are saved in a run; TRUNDLE_SAVE_ALL=1 lifts the limit")


def test_the_bound_can_be_lifted(described: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("trundle.sim.sensors.cameras.image_saver._MAX_IMAGES", 1)
    monkeypatch.setenv("TRUNDLE_SAVE_ALL", "1")

    assert saved(described, "saved_images/shots").report.warnings == []
    assert len(list(tmp_path.rglob("*.jpg"))) == 2


def test_a_folder_that_cannot_be_made_ends_the_saving_with_one_warning(described: Any, tmp_path: Path) -> None:
    (tmp_path / "saved_images").touch()

    (warning,) = saved(described, "saved_images/shots").report.warnings

    assert "Not a directory; saving stopped" in warning


def test_a_picture_that_does_not_fit_on_the_disk_is_removed(described: Any, tmp_path: Path) -> None:
    resource = pytest.importorskip("resource", reason="this system limits no files")
    sim, before = started(described, "saved_images/shots"), resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (100, before[1]))
    try:
        sim.run(0.1)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)

    (warning,) = sim.report.warnings
    assert "File too large; saving stopped" in warning
    assert list((tmp_path / "saved_images/shots").iterdir()) == []

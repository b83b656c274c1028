"""An .rviz file is saved below the folder where Trundle was started, and replaces others only after confirmation."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.page_client import ProtocolClient

from trundle.base.http.page_address import PageAddress
from trundle.page import PageServer, RvizFile, Session

TEXT = "Panels: []\n"


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("place") / "started"
    (folder / "rviz").mkdir(parents=True)
    return folder


@pytest.fixture(scope="module")
def client(folder: Path) -> Iterator[ProtocolClient]:
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        page = PageServer.start(Session(title="t", kind="graph"), at=PageAddress(port=0))
    with page, ProtocolClient(page.url) as client:
        yield client


def _save(client: ProtocolClient, name: str, text: str = TEXT, **more: Any) -> dict[str, Any]:
    count = len(client.jsons)
    client.send("trundle/request", id=count, request="save_rviz_as", file=name, text=text, **more)
    client.until(lambda: client.jsons[count:] and client.last("trundle/response")["id"] == count)
    return client.last("trundle/response")


@pytest.mark.parametrize("name", ["car.rviz", "rviz/car.rviz", "new/folder/car (1).rviz", "ein Wägelchen.rviz"])
def test_a_file_is_written_to_its_path(client: ProtocolClient, folder: Path, name: str) -> None:
    assert _save(client, name)["file"] == name
    assert (folder / name).read_text() == TEXT


def test_an_existing_file_is_replaced_only_on_request(client: ProtocolClient, folder: Path) -> None:
    path = folder / "mine.rviz"
    path.write_text("mine")
    path.chmod(0o600)

    assert _save(client, "mine.rviz")["exists"] == "mine.rviz"
    assert path.read_text() == "mine"
    assert _save(client, "mine.rviz", replace=True)["file"] == "mine.rviz"
    assert (path.read_text(), path.stat().st_mode & 0o777) == (TEXT, 0o600)


def test_the_session_has_the_newest_file_until_its_owner_sets_another(folder: Path) -> None:
    first = RvizFile(name="given.rviz", text="given", writable=True)

    def session() -> dict[str, Any]:
        with ProtocolClient(page.url) as late:
            late.subscribe("trundle/session")
            late.until(lambda: late.payloads("trundle/session"))
            return json.loads(late.payloads("trundle/session")[-1])

    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        page = PageServer.start(
            Session(title="t", kind="graph", rviz=first, fixed_frame="odom"), at=PageAddress(port=0)
        )
    with page, ProtocolClient(page.url) as client:
        _save(client, "newest.rviz", "newest")
        current = session()
        assert current["rviz"] == {"name": "newest.rviz", "text": "newest", "writable": True, "saved": True}
        assert current["fixed_frame"] is None
        page.set_session(Session(title="other", kind="graph", rviz=first))
        assert session()["rviz"]["name"] == "newest.rviz"
        page.set_session(Session(title="other", kind="graph", rviz=RvizFile(name="b", text="b", writable=False)))
        client.until(lambda: session()["rviz"]["name"] == "b")


@pytest.mark.parametrize("replace", [False, True])
def test_paths_out_of_the_folder_are_refused(client: ProtocolClient, folder: Path, replace: bool) -> None:
    outside = folder.parent / "outside.rviz"
    outside.write_text("mine")
    (folder / "file").touch()
    for link, target in (("link.rviz", outside), ("out", folder.parent)):
        if not (folder / link).is_symlink():
            (folder / link).symlink_to(target)
    refusals = {
        "../outside.rviz": "below the folder",
        "rviz/../../outside.rviz": "below the folder",
        str(outside): "below the folder",
        "link.rviz": "a link leads elsewhere",
        "out/outside.rviz": "a link leads elsewhere",
        "out/new.rviz": "a link leads elsewhere",
        "file/car.rviz": "file is no folder",
        "car.yaml": "ends in .rviz",
        "car.rviz\n.rviz": "below the folder",
        "car\0.rviz": "below the folder",
        "rviz/.rviz": "below the folder",
        "": "not a request",
        "x" * 200 + ".rviz": "below the folder",
        "😀" * 80 + ".rviz": "below the folder",
        "😀" * 80 + "/car.rviz": "below the folder",
        "COM¹.rviz": "below the folder",
        "nul .rviz": "below the folder",
        "conin$.rviz": "below the folder",
    }
    before = sorted(folder.parent.rglob("*"))

    answers = {name: _save(client, name, replace=replace) for name in refusals}

    assert [name for name, reason in refusals.items() if reason not in answers[name].get("error", "")] == []
    assert outside.read_text() == "mine"
    assert sorted(folder.parent.rglob("*")) == before


@pytest.mark.parametrize("replace", [False, True])
def test_folders_and_loops_of_links_are_refused(client: ProtocolClient, folder: Path, replace: bool) -> None:
    (folder / "folder.rviz").mkdir(exist_ok=True)
    if not (folder / "loop.rviz").is_symlink():
        (folder / "loop.rviz").symlink_to("loop.rviz")

    assert _save(client, "folder.rviz", replace=replace)["error"] == "folder.rviz: this is no file; choose another name"
    assert _save(client, "loop.rviz", replace=replace).get("file") is None

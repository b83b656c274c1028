"""Paths where worlds are saved, and refusals."""

import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.page.simulated_world.fake_server import sent
from tests.page.simulated_world.worlds import loaded, model

from trundle.base.diagnostics import UsageError
from trundle.base.output_folder import save_files
from trundle.page import SaveWorld
from trundle.page.requests.answers import DONE, Answer
from trundle.page.simulated_world.current_world import current_world
from trundle.page.simulated_world.world_saver import WorldSaver, find_world
from trundle.robots.packages import Packages
from trundle.sim.simulation import Simulation

Ask = Callable[[Path, SaveWorld], dict[str, Any]]


@pytest.mark.parametrize(
    "name",
    [
        "../out.sdf", "a/../../out.sdf", "/tmp/out.sdf", "a//b.sdf", "./a.sdf", ".hidden.sdf", "a/.git/b.sdf", "a.txt",
        "sdf",
        "a.sdf ", "a\\b.sdf", "C:a.sdf", "a\n.sdf", "a\0.sdf", "x" * 150 + ".sdf", "file.sdf/", "dir.sdf",
    ],
)  # fmt: skip
def test_paths_out_of_the_folder_are_refused(tmp_path: Path, name: str) -> None:
    (tmp_path / "dir.sdf").mkdir()
    with pytest.raises(UsageError):
        find_world(tmp_path, name)


def test_symbolic_links_out_of_the_folder_are_refused(tmp_path: Path) -> None:
    root, outside = tmp_path / "root", tmp_path / "outside"
    root.mkdir()
    outside.mkdir()
    (root / "way").symlink_to(outside)
    (root / "out.sdf").symlink_to(outside / "there.sdf")
    for name in ("way/a.sdf", "way/deeper/a.sdf", "out.sdf"):
        with pytest.raises(UsageError, match="a link leads elsewhere"):
            find_world(root, name)
    assert find_world(root, "new/a b.world") == root / "new" / "a b.world"


@pytest.fixture
def ask(tmp_path_factory: pytest.TempPathFactory) -> Ask:
    simulation, _ = loaded(tmp_path_factory.mktemp("cart"), model("cart"))
    return lambda root, request: _answer(simulation, root, request)


def _answer(simulation: Simulation, root: Path, request: SaveWorld) -> dict[str, Any]:
    answers: list[dict[str, Any]] = []
    done = threading.Event()

    def respond(request_id: int, error: str | None = None, answer: Answer = DONE) -> None:
        assert error is not None or isinstance(answer, SaveWorld.answer), "the answer has a type of the request's class"
        answers.append({"id": request_id, "error": error, **sent(answer)})
        done.set()

    saver = WorldSaver(respond, Packages({}, start=root), root)
    saver.save(7, request, current_world(simulation), simulation.seed)
    assert done.wait(60.0)
    saver.close()
    return answers[0]


def test_a_file_is_replaced_only_after_confirmation(tmp_path: Path, ask: Ask) -> None:
    assert ask(tmp_path, SaveWorld("worlds/mine.sdf"))["file"] == "worlds/mine.sdf"
    file = tmp_path / "worlds" / "mine.sdf"
    file.write_text("precious")
    assert ask(tmp_path, SaveWorld("worlds/mine.sdf"))["exists"] == "worlds/mine.sdf"
    assert file.read_text() == "precious"
    assert ask(tmp_path, SaveWorld("worlds/mine.sdf", replace=True))["file"] == "worlds/mine.sdf"
    assert '<model name="cart"' in file.read_text()


def test_an_equal_copy_need_not_be_replaced(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text("v 0 0 0")
    files = {tmp_path / "copies" / name: tmp_path / "a.obj" for name in "123456"}

    assert save_files(tmp_path, files, replace=False) is None
    assert save_files(tmp_path, files, replace=False) is None
    (tmp_path / "copies" / "2").write_text("precious")
    assert save_files(tmp_path, files, replace=False) == "copies/2"
    assert (tmp_path / "copies" / "2").read_text() == "precious"
    for copy in files:
        copy.write_text("other")
    assert save_files(tmp_path, files, replace=False) == "copies/1, copies/2, copies/3, copies/4 and 2 more"
    assert save_files(tmp_path, files, replace=True) is None
    assert {copy.read_text() for copy in files} == {"v 0 0 0"}


def test_a_refusal_has_a_reason_and_a_download_writes_nothing(tmp_path: Path, ask: Ask) -> None:
    assert "below the folder where Trundle was started" in ask(tmp_path, SaveWorld("../a.sdf"))["error"]
    assert '<model name="cart"' in ask(tmp_path, SaveWorld(None))["sdf"]
    assert list(tmp_path.iterdir()) == []

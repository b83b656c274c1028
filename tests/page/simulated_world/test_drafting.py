"""Editing a draft of a model of a running world, by requests of the page."""

import os
import queue
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.page.simulated_world.fake_server import sent

from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.page import AddPart, BeginDraft, DraftAction, FinishDraft, LeaveDraft, SaveDraft, SetField, SetMass
from trundle.page.requests.answers import DONE, Answer
from trundle.page.shown_world import BareWorld
from trundle.page.simulated_world.code_consent import CodeConsent
from trundle.page.simulated_world.drafting import Drafting, ShownDraft
from trundle.page.simulated_world.edits import edit
from trundle.page.simulated_world.model_edits import ModelEdits
from trundle.robots.description import load_text
from trundle.robots.packages import Packages
from trundle.sim.simulation import Simulation

BOX = "<geometry><box><size>1 1 1</size></box></geometry>"
WORLD = f"""<sdf version="1.6"><world name="yard"><model name="crate"><pose>3 0 0.5 0 0 0</pose>
<!-- of wood --><link name="body"><collision name="c">{BOX}</collision><visual name="v">{BOX}</visual></link></model>
</world></sdf>"""
_PATIENCE_S = 30.0


class Editor:
    """Makes requests, and waits for their answers as the page's owner does."""

    def __init__(self, folder: Path) -> None:
        (folder / "yard.sdf").write_text(WORLD)
        packages, report = Packages({}, start=folder), Diagnostics()
        world = load_text(WORLD, name=str(folder / "yard.sdf"), folder=folder, packages=packages, report=report).world
        self.simulation = Simulation(world, report)
        self.world = BareWorld(self.simulation)
        self.edits = ModelEdits(self.world)
        self._answers: queue.SimpleQueue[tuple[str | None, Answer]] = queue.SimpleQueue()
        self.drafting = Drafting(self._respond, self.world.packages, os.environ, folder, CodeConsent(os.environ))
        self.shown: list[ShownDraft] = []

    def _respond(self, request_id: int, error: str | None = None, answer: Answer = DONE) -> None:
        del request_id
        self._answers.put((error, answer))

    def ask(self, action: DraftAction) -> dict[str, Any]:
        """Make a request; return the answer's fields, or `error` for a refusal."""
        self.drafting.handle(1, action, self.simulation)
        end = time.monotonic() + _PATIENCE_S
        while time.monotonic() < end:
            self.shown += self.drafting.poll(self.world, self.edits)
            try:
                error, answer = self._answers.get(timeout=0.01)
            except queue.Empty:
                continue
            self.shown += self.drafting.poll(self.world, self.edits)
            if error is not None:
                return {"error": error}
            assert isinstance(answer, action.answer), "the answer has a type of the request's class"
            return sent(answer)
        raise AssertionError(f"no answer to {action}")


@pytest.fixture
def editor(tmp_path: Path) -> Iterator[Editor]:
    editor = Editor(tmp_path)
    yield editor
    editor.drafting.close()


def test_a_finished_draft_replaces_its_original(editor: Editor) -> None:
    assert editor.ask(BeginDraft(model="crate")) == {}
    draft = editor.shown[-1].info
    assert draft is not None
    assert draft.original == "crate"
    assert draft.pose[:3] == pytest.approx([3.0, 0.0, 0.5])
    assert editor.shown[-1].files.keys() >= {file.url for file in draft.files}
    with pytest.raises(UsageError, match="edited already"):
        editor.drafting.handle(1, BeginDraft(model=None), editor.simulation)

    editor.ask(SetField(part=("link", "body"), field="inertial/mass", value=(7.0,)))
    assert editor.simulation["crate"].links[0].link.inertial.mass == 1.0
    assert editor.ask(FinishDraft()) == {"name": "crate"}

    crate = editor.simulation["crate"]
    assert crate.links[0].link.inertial.mass == 7.0
    assert crate.pose.position == pytest.approx((3.0, 0.0, 0.5))
    assert editor.shown[-1].info is None
    assert not editor.drafting.is_open


def test_a_draft_includes_edits_made_while_the_world_ran(editor: Editor) -> None:
    edit(SetMass(model="crate", link="body", mass=4.0), editor.simulation)

    editor.ask(BeginDraft(model="crate"))

    draft = editor.shown[-1].info
    assert draft is not None
    assert next(part for part in draft.parts if part.tag == "link").mass == 4.0


def test_a_draft_that_cannot_be_spawned_keeps_its_original(editor: Editor) -> None:
    """This world cannot start plugins."""
    editor.ask(BeginDraft(model="crate"))
    editor.ask(AddPart(into=(), kind="plugin", type="libgazebo_ros_p3d.so"))

    assert "would not run here" in editor.ask(FinishDraft())["error"]

    assert [model.name for model in editor.simulation.models] == ["crate"]
    assert editor.drafting.is_open
    assert editor.ask(LeaveDraft()) == {}


def test_a_drafts_code_needs_consent_again_after_a_change(
    editor: Editor, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An error means that the draft passed the question: this world cannot start plugins."""
    monkeypatch.setenv("TRUNDLE_PLUGIN_PATH", str(tmp_path))
    (tmp_path / "code.py").write_text("first = 1")
    editor.ask(BeginDraft(model="crate"))
    editor.ask(AddPart(into=(), kind="plugin", type="code.py"))
    question = editor.ask(FinishDraft())
    assert question["code"] == [str(tmp_path / "code.py")]
    assert editor.ask(FinishDraft(consent="true"))["code"]
    (tmp_path / "code.py").write_text("second = 2")
    again = editor.ask(FinishDraft(consent=question["consent"]))
    assert again["code"]

    assert "would not run here" in editor.ask(FinishDraft(consent=again["consent"]))["error"]
    assert editor.ask(FinishDraft(consent=again["consent"]))["code"]
    editor.ask(LeaveDraft())


def test_an_empty_model_is_not_inserted(editor: Editor) -> None:
    editor.ask(BeginDraft(model=None))

    assert "no links yet" in editor.ask(FinishDraft())["error"]
    assert "no shape 'wheel'" in editor.ask(AddPart(into=(), kind="link", type="wheel"))["error"]


def test_files_are_replaced_only_after_confirmation(editor: Editor, tmp_path: Path) -> None:
    editor.ask(BeginDraft(model="crate"))

    assert editor.ask(SaveDraft(folder="models/crate")) == {"file": "models/crate"}
    file = tmp_path / "models/crate/model.sdf"
    assert "<!-- of wood -->" in file.read_text()
    assert (tmp_path / "models/crate/model.config").is_file()
    editor.ask(SetField(part=(), field="@name", value="box"))
    both = "models/crate/model.sdf, models/crate/model.config"
    assert editor.ask(SaveDraft(folder="models/crate")) == {"exists": both}
    assert '<model name="crate">' in file.read_text()
    assert editor.ask(SaveDraft(folder="models/crate", replace=True)) == {"file": "models/crate"}
    assert '<model name="box">' in file.read_text()
    for name in ("../crate", "/tmp/crate", "models/.hidden"):
        assert "below the folder" in editor.ask(SaveDraft(folder=name))["error"]


def test_edits_without_a_draft_are_refused(editor: Editor) -> None:
    with pytest.raises(UsageError, match="no model is being edited"):
        editor.drafting.handle(1, LeaveDraft(), editor.simulation)

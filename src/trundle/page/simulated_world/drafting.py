"""The draft: a copy of a model that the user edits, checked and drawn on its own thread."""

import os
import queue
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics, TrundleError, UsageError
from trundle.page import (
    AddPart,
    BeginDraft,
    CopyPart,
    DeleteModel,
    DraftAction,
    FinishDraft,
    LeaveDraft,
    ListOffers,
    Part,
    PlaceLink,
    RedoDraft,
    RemovePart,
    RestoreModel,
    SaveDraft,
    SetField,
    UndoDraft,
)
from trundle.robots.description import copy_model
from trundle.robots.model import Model
from trundle.robots.packages import Packages
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

from ..model_editor.draft import Draft
from ..model_editor.model_files import folder_name
from ..model_editor.new_parts import new_model
from ..model_editor.offers import draft_offers
from ..model_editor.overview import draft_overview
from ..model_editor.reader import ModelReader
from ..requests.answers import DONE, Answer, EditedPart, Inserted
from ..shown_world import ShownWorld
from ..world.draft_info import DraftInfo, FileUrl
from .code_consent import CodeConsent
from .controls import reason_of
from .current_world import current_world
from .edits import find_model
from .insertion import free_name
from .model_edits import ModelEdits
from .model_saver import save_draft
from .world_files import WorldFiles

FIRST_BODY = 65536
"""Number of the draft's first link among the bodies that the client draws."""
_MAX_WAITING = 20


class ShownDraft(Struct, frozen=True, kw_only=True):
    """Draft as the client draws it."""

    info: DraftInfo | None
    model: Model | None = None
    """Flat model at its pose in the world; None: no draft."""
    resources: tuple[str, ...] = ()
    """URLs of all files that it needs."""
    files: dict[str, bytes] = {}
    """URL → content of new files."""


NO_DRAFT = ShownDraft(info=None)


class _Finished(Struct, frozen=True, kw_only=True):
    """Draft to be inserted into the world."""

    request_id: int
    model: Model
    original: str | None
    """Model that it replaces."""


class Drafting:
    """Edits one draft; belongs to the simulation's thread, but calls `respond` on the draft's thread, too."""

    def __init__(
        self,
        respond: Callable[..., None],
        packages: Packages,
        environment: Mapping[str, str],
        root: Path,
        consent: CodeConsent,
    ) -> None:
        """Create it, without a draft.

        Args:
            respond: answers a request by its id, with an error or an `Answer`.
            packages: finds models.
            environment: variables that locate plugins.
            root: folder that drafts are saved below.
            consent: asks the user before code is run.
        """
        self._respond, self._consent = respond, consent
        self._packages = packages
        self._reader = ModelReader(packages, environment, root)
        self._root = root
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="trundle-page-draft")
        self._shown: queue.SimpleQueue[ShownDraft] = queue.SimpleQueue()
        self._finished: queue.SimpleQueue[_Finished] = queue.SimpleQueue()
        self._waiting = 0
        self._is_open = False
        self._draft: Draft | None = None
        self._files = WorldFiles()

    @property
    def is_open(self) -> bool:
        """True while a model is being edited."""
        return self._is_open

    def handle(self, request_id: int, action: DraftAction, simulation: Simulation) -> None:
        """Queue a request for the draft's thread, which answers it.

        Raises:
            TrundleError: the request cannot be executed.
        """
        if self._waiting >= _MAX_WAITING:
            raise UsageError(f"{_MAX_WAITING} edits are waiting already")
        if isinstance(action, BeginDraft):
            self._submit(request_id, self._begin(action, simulation))
            return
        if not self._is_open and not isinstance(action, ListOffers):
            raise UsageError("no model is being edited")
        self._submit(request_id, lambda: self._do(request_id, action))

    def _submit(self, request_id: int, work: Callable[[], Answer | None]) -> None:
        self._waiting += 1
        self._thread.submit(self._run, request_id, work)

    def _run(self, request_id: int, work: Callable[[], Answer | None]) -> None:
        try:
            answer = work()
            if answer is not None:
                self._respond(request_id, answer=answer)
        except TrundleError as error:
            self._respond(request_id, reason_of(error))
        except Exception as error:  # a fault of the editor must not end the simulation
            self._respond(request_id, f"this cannot be edited: {type(error).__name__}: {error}")
        finally:
            self._waiting -= 1

    def _begin(self, action: BeginDraft, simulation: Simulation) -> Callable[[], Answer]:
        """Copy the model from the simulation; return the rest of the work, for the draft's thread."""
        if self._is_open:
            raise UsageError("a model is being edited already: finish or leave it first")
        if action.model is None:
            name = free_name("model", {model.name for model in simulation.models})
            text, world_from_model = new_model(name), Pose(action.position)
            self._is_open = True
            return lambda: self._open(text, None, world_from_model)
        original = find_model(simulation, action.model).model
        world = current_world(simulation)
        posed = next(model for model in world.models if model.name == original.name)
        self._is_open = True

        def copy() -> Answer:
            text = copy_model(original, packages=self._packages, folder=self._root)
            return self._open(text, original.name, posed.world_from_model)

        return copy

    def _open(self, text: bytes, original: str | None, world_from_model: Pose) -> Answer:
        try:
            self._draft = Draft(text, self._reader, original=original, world_from_model=world_from_model)
        except BaseException:
            self._is_open = False
            raise
        self._show()
        return DONE

    def _do(self, request_id: int, action: DraftAction) -> Answer | None:
        """Execute a request on the draft's thread; return its answer, None: it is answered later."""
        if isinstance(action, ListOffers):
            return draft_offers(self._packages)
        draft = self._draft
        if draft is None:
            raise UsageError("no model is being edited")
        match action:
            case SaveDraft():
                return save_draft(draft, action, self._root, self._packages)
            case FinishDraft():
                return self._finish(request_id, action, draft)
            case LeaveDraft():
                self._close()
                return DONE
            case _:
                part = _edit(draft, action)
                self._show()
                return EditedPart(part=part)

    def _finish(self, request_id: int, action: FinishDraft, draft: Draft) -> Answer | None:
        model = draft.checked.model
        if not model.links:
            raise UsageError("the model has no links yet")
        if (question := self._consent.question(model, action.consent)) is not None:
            return question
        model = replace(model, world_from_model=draft.world_from_model)
        self._finished.put(_Finished(request_id=request_id, model=model, original=draft.original))
        return None

    def _show(self) -> None:
        """Write the draft's files for the client, on the draft's thread."""
        draft = self._draft
        assert draft is not None
        model = replace(draft.checked.model, world_from_model=draft.world_from_model)
        world = replace(draft.checked.world, models=(model,), lights=(), roads=())
        numbers = {f"{model.name}::{link.name}": FIRST_BODY + index for index, link in enumerate(model.links)}
        named, files = self._files.update(world, numbers.__getitem__, Diagnostics())
        info = replace(
            draft_overview(draft),
            files=tuple(FileUrl(id="draft", url=file.url) for file in named.files if file.id),
            folder=folder_name(draft.name) if os.access(self._root, os.W_OK) else None,
        )
        urls = (file.url for file in named.files)
        self._shown.put(ShownDraft(info=info, model=model, resources=(*urls, *named.resources), files=files))

    def _close(self) -> None:
        self._draft = None
        self._is_open = False
        self._files = WorldFiles()
        self._shown.put(NO_DRAFT)

    def poll(self, world: ShownWorld, edits: ModelEdits) -> list[ShownDraft]:
        """Insert finished drafts into the world; return the drafts to show since the last call."""
        while (finished := _next(self._finished)) is not None:
            try:
                name = _spawn(finished, world, edits)
            except TrundleError as error:
                self._respond(finished.request_id, reason_of(error))
            else:
                self._submit(finished.request_id, lambda name=name: (self._close(), Inserted(name=name))[1])
        return list(iter(lambda: _next(self._shown), None))

    def close(self) -> None:
        """Stop after the current edit."""
        self._thread.shutdown(wait=False, cancel_futures=True)


def _spawn(finished: _Finished, world: ShownWorld, edits: ModelEdits) -> str:
    """Insert a model into the world, replacing its original; return its name."""
    present, original = {model.name for model in world.simulation.models}, finished.original
    name = free_name(finished.model.name, present - {original})
    if original is None or original not in present:
        world.spawn(replace(finished.model, name=name))
        return name
    edits.handle(DeleteModel(original))
    try:
        world.spawn(replace(finished.model, name=name))
    except TrundleError:
        edits.handle(RestoreModel(original))
        raise
    return name


def _edit(draft: Draft, action: DraftAction) -> Part:
    match action:
        case SetField(part, field, value):
            return draft.set(part, field, value)
        case PlaceLink(part, position, orientation):
            return draft.move(part, Pose(position, orientation))
        case AddPart(into, kind, type_):
            return draft.add(into, kind, type_)
        case CopyPart(part):
            return draft.copy(part)
        case RemovePart(part):
            return draft.remove(part)
        case UndoDraft():
            draft.undo()
        case RedoDraft():
            draft.redo()
        case _:
            raise UsageError("this request does not edit a model")
    return ()


def _next(waiting: "queue.SimpleQueue[Any]") -> Any:
    try:
        return waiting.get_nowait()
    except queue.Empty:
        return None

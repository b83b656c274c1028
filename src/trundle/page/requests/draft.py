"""Requests that edit the draft, a copy of a model; the thread that owns the simulation polls them."""

from typing import Annotated, Literal, TypeAlias

import msgspec

from .answers import CodeQuestion, DraftOffers, EditedPart, FilesExist, Inserted, SavedFile
from .edits import Action, Name, Quaternion, Triple, check_direction
from .world import Consent, FileName

Part: TypeAlias = Annotated[tuple[Name, ...], msgspec.Meta(max_length=12)]
"""Address of an element by tags and names: ("link", "base", "sensor", "eye"); empty: the model itself."""
_Number: TypeAlias = Annotated[float, msgspec.Meta(ge=-1e12, le=1e12)]
Value: TypeAlias = (
    Annotated[str, msgspec.Meta(max_length=4000)]
    | Annotated[tuple[_Number | None, ...], msgspec.Meta(max_length=9)]
    | None
)
"""Text; numbers, None for unchanged ones; or None: the default."""


class BeginDraft(Action, frozen=True, tag="begin_draft"):
    """Start a draft from a model of the world or from nothing; the simulation pauses until the draft is left."""

    model: Name | None
    """None: a new model."""
    position: Triple = (0.0, 0.0, 0.0)
    """Position of a new model [m]."""


class ListOffers(Action, frozen=True, tag="draft_offers"):
    """List the plugins, sensors, joints and meshes that can be added to a draft."""

    answer = DraftOffers


class SetField(Action, frozen=True, tag="draft_set"):
    """Set one value of a part."""

    answer = EditedPart

    part: Part
    field: Name
    value: Value


class PlaceLink(Action, frozen=True, tag="draft_place"):
    """Move a link, or the model as a whole, to a pose in the world."""

    answer = EditedPart

    part: Part
    position: Triple
    """[m]"""
    orientation: Quaternion
    """Quaternion wxyz of any length except zero."""

    def __post_init__(self) -> None:
        """Check that the quaternion is not zero."""
        check_direction(self.orientation)


class AddPart(Action, frozen=True, tag="draft_add"):
    """Add a part."""

    answer = EditedPart

    into: Part
    """Part that it is added to; for a joint, its child."""
    kind: Literal["link", "joint", "sensor", "plugin", "visual", "collision"]
    type: Name
    """Shape or URI of a mesh, type of the joint or sensor, file name of the plugin."""


class CopyPart(Action, frozen=True, tag="draft_copy"):
    """Add a copy of a part."""

    answer = EditedPart

    part: Part


class RemovePart(Action, frozen=True, tag="draft_remove"):
    """Remove a part, and the joints of a link."""

    answer = EditedPart

    part: Part


class UndoDraft(Action, frozen=True, tag="draft_undo"):
    """Undo the latest edit of the draft."""

    answer = EditedPart


class RedoDraft(Action, frozen=True, tag="draft_redo"):
    """Redo the edit undone last."""

    answer = EditedPart


class SaveDraft(Action, frozen=True, tag="draft_save"):
    """Write model.sdf and model.config."""

    answer = SavedFile | FilesExist

    folder: FileName
    """Path below the folder where the simulation was started."""
    replace: bool = False
    """True if the user has confirmed to replace the files."""


class FinishDraft(Action, frozen=True, tag="draft_finish"):
    """Insert the draft into the world, replacing its original.

    A model with code needs the user's consent.
    """

    answer = Inserted | CodeQuestion

    consent: Consent = None
    """Token of the `CodeQuestion` to which the user has consented."""


class LeaveDraft(Action, frozen=True, tag="draft_leave"):
    """Discard the draft."""


DraftAction: TypeAlias = (
    BeginDraft
    | ListOffers
    | SetField
    | PlaceLink
    | AddPart
    | CopyPart
    | RemovePart
    | UndoDraft
    | RedoDraft
    | SaveDraft
    | FinishDraft
    | LeaveDraft
)

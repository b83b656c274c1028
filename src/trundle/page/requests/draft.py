"""Requests that edit a copy of a model, the draft; the thread that owns the simulation polls them."""

from typing import Annotated, Literal, TypeAlias

import msgspec

from .answers import CodeQuestion, DraftOffers, EditedPart, FilesExist, Inserted, SavedFile
from .edits import Action, Name, Quaternion, Triple, check_direction
from .world import Consent, FileName

Part: TypeAlias = Annotated[tuple[Name, ...], msgspec.Meta(max_length=12)]
"""Element of the model by tags and names: ("link", "base", "sensor", "eye"); empty: the model itself."""
_Number: TypeAlias = Annotated[float, msgspec.Meta(ge=-1e12, le=1e12)]
Value: TypeAlias = (
    Annotated[str, msgspec.Meta(max_length=4000)]
    | Annotated[tuple[_Number | None, ...], msgspec.Meta(max_length=9)]
    | None
)
"""Text; numbers, None where one stays as it is; or None: the default."""


class BeginDraft(Action, frozen=True, tag="begin_draft"):
    """Copy a model of the world, or begin one from nothing; time pauses until the draft is left."""

    model: Name | None
    """None: a new one."""
    position: Triple = (0.0, 0.0, 0.0)
    """Place of a new one [m]."""


class ListOffers(Action, frozen=True, tag="draft_offers"):
    """Ask for the plugins, sensors and meshes that a draft can be given."""

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
    """Quaternion wxyz, of any length but zero."""

    def __post_init__(self) -> None:
        """Check that the quaternion has a direction."""
        check_direction(self.orientation)


class AddPart(Action, frozen=True, tag="draft_add"):
    """Add a part."""

    answer = EditedPart

    into: Part
    """Part that gets it; of a joint, its child."""
    kind: Literal["link", "joint", "sensor", "plugin", "visual", "collision"]
    type: Name
    """Shape or URI of a mesh, type of the joint or sensor, file name of the plugin."""


class CopyPart(Action, frozen=True, tag="draft_copy"):
    """Add a copy of a part."""

    answer = EditedPart

    part: Part


class RemovePart(Action, frozen=True, tag="draft_remove"):
    """Remove a part; a link goes with its joints."""

    answer = EditedPart

    part: Part


class UndoDraft(Action, frozen=True, tag="draft_undo"):
    """Take the last edit of the draft back."""

    answer = EditedPart


class RedoDraft(Action, frozen=True, tag="draft_redo"):
    """Do the edit again that was taken back last."""

    answer = EditedPart


class SaveDraft(Action, frozen=True, tag="draft_save"):
    """Write model.sdf and model.config."""

    answer = SavedFile | FilesExist

    folder: FileName
    """Path below the folder where the simulation was started."""
    replace: bool = False
    """True if a person has agreed to replace the files."""


class FinishDraft(Action, frozen=True, tag="draft_finish"):
    """Put the draft into the world, in place of the model that it is a copy of.

    A person is asked about a model with code.
    """

    answer = Inserted | CodeQuestion

    consent: Consent = None
    """Word of the answer that showed the code, if a person has agreed."""


class LeaveDraft(Action, frozen=True, tag="draft_leave"):
    """Throw the draft away."""


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

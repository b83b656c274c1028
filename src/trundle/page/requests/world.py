"""Requests that save a simulated world, or insert, copy, delete and reset its models and lights."""

from typing import Annotated, Literal, TypeAlias

import msgspec

from .answers import (
    CodeQuestion,
    FilesExist,
    Inserted,
    ModelList,
    ReplayPage,
    ReplayScene,
    SavedWorld,
    WorldText,
)
from .edits import Action, Name, Triple

Consent: TypeAlias = Annotated[str, msgspec.Meta(max_length=100)] | None
FileName: TypeAlias = Annotated[str, msgspec.Meta(min_length=1, max_length=300)]


class SaveWorld(Action, frozen=True, tag="save_world"):
    """Write the world as SDF."""

    answer = SavedWorld | WorldText | FilesExist

    file: FileName | None
    """Path below the folder where the simulation was started; None: answer with the SDF text."""
    replace: bool = False
    """True if the user has confirmed to replace the file."""


class SaveReplay(Action, frozen=True, tag="replay"):
    """Make a replay of the last minutes."""

    answer = ReplayPage | ReplayScene

    view: Annotated[str, msgspec.Meta(max_length=4000)] | None = None
    """Initial view of the replay page: JSON of a view as in an .rviz file."""
    format: Literal["html", "glb"] = "html"


class ListModels(Action, frozen=True, tag="models"):
    """List the models that can be inserted."""

    answer = ModelList


class InsertModel(Action, frozen=True, tag="insert"):
    """Insert a model of the model path or a simple shape; a model with code needs the user's consent."""

    answer = Inserted | CodeQuestion

    model: FileName
    """Name of the model's folder; if `is_shape`: `box`, `sphere` or `cylinder`."""
    position: Triple
    """Point on the floor [m]."""
    is_shape: bool = False
    consent: Consent = None
    """Token of the `CodeQuestion` to which the user has consented."""


class InsertLight(Action, frozen=True, tag="insert_light"):
    """Insert a light above a point."""

    answer = Inserted

    type: Literal["point", "directional", "spot"]
    position: Triple
    """Point on the floor [m]."""


class DeleteLight(Action, frozen=True, tag="delete_light"):
    """Remove a light of the world."""

    light: Name


class RestoreLight(Action, frozen=True, tag="restore_light"):
    """Restore a light that the page deleted."""

    light: Name


class CopyModel(Action, frozen=True, tag="copy"):
    """Add a copy of a model in its current state, with its sensors and plugins."""

    model: Name
    name: Annotated[str, msgspec.Meta(min_length=1, max_length=500)]
    """Name of the copy."""
    offset: Triple
    """Offset of the copy from the model, in the world [m]."""


class DeleteModel(Action, frozen=True, tag="delete"):
    """Remove a model from the world, with its sensors and plugins."""

    model: Name


class RestoreModel(Action, frozen=True, tag="restore"):
    """Restore a model that the page deleted, in its former state, with its sensors and plugins."""

    model: Name


class RenderModel(Action, frozen=True, tag="model_picture"):
    """Draw a model of the model path; answered by `PageServer.respond_picture`."""

    model: FileName
    kind: Literal["picture", "shape"] = "picture"
    """PNG, or GLB for the preview at the pointer."""


InsertAction: TypeAlias = ListModels | InsertModel | InsertLight


class ResetModel(Action, frozen=True, tag="reset_model"):
    """Reset a model to its initial pose and joint positions, at rest, with motors off; its plugins are reset, too."""

    model: Name


class UndoReset(Action, frozen=True, tag="undo_reset"):
    """Restore a model's state before its latest reset, with motors, wrenches and the state of its plugins."""

    model: Name


ModelAction: TypeAlias = CopyModel | DeleteModel | RestoreModel | ResetModel | UndoReset | DeleteLight | RestoreLight

"""Requests that save a simulated world, or put something into it."""

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
    """Path below the folder where the simulation was started; None: answer with the text, `sdf`."""
    replace: bool = False
    """True if a person has agreed to replace the file."""


class SaveReplay(Action, frozen=True, tag="replay"):
    """Make a replay of the last minutes."""

    answer = ReplayPage | ReplayScene

    view: Annotated[str, msgspec.Meta(max_length=4000)] | None = None
    """JSON of the view from which a page is seen first, as an .rviz file has it."""
    format: Literal["html", "glb"] = "html"


class ListModels(Action, frozen=True, tag="models"):
    """Ask for the models that can be inserted."""

    answer = ModelList


class InsertModel(Action, frozen=True, tag="insert"):
    """Put a model of the model path, or a simple shape, into the world; a person is asked about a model with code."""

    answer = Inserted | CodeQuestion

    model: FileName
    """Name of its folder, or `box`, `sphere`, `cylinder` where `is_shape`."""
    position: Triple
    """Point on the floor [m]."""
    is_shape: bool = False
    consent: Consent = None
    """Word of the answer that showed the code, if a person has agreed."""


class InsertLight(Action, frozen=True, tag="insert_light"):
    """Put a light above a point."""

    answer = Inserted

    type: Literal["point", "directional", "spot"]
    position: Triple
    """Point on the floor [m]."""


class DeleteLight(Action, frozen=True, tag="delete_light"):
    """Remove a light of the world."""

    light: Name


class RestoreLight(Action, frozen=True, tag="restore_light"):
    """Put back a light that the page deleted."""

    light: Name


class CopyModel(Action, frozen=True, tag="copy"):
    """Add a copy of a model in the state that it has, with its sensors and plugins."""

    model: Name
    name: Annotated[str, msgspec.Meta(min_length=1, max_length=500)]
    """Name of the copy."""
    offset: Triple
    """From the model to its copy, in the world [m]."""


class DeleteModel(Action, frozen=True, tag="delete"):
    """Remove a model from the world, with its sensors and plugins."""

    model: Name


class RestoreModel(Action, frozen=True, tag="restore"):
    """Put back a model that the page deleted, in the state that it had, with its sensors and plugins."""

    model: Name


class RenderModel(Action, frozen=True, tag="model_picture"):
    """Draw a model of the model path; answered by `PageServer.respond_picture`."""

    model: FileName
    kind: Literal["picture", "shape"] = "picture"
    """A PNG, or the GLB of what follows the pointer until it is placed."""


InsertAction: TypeAlias = ListModels | InsertModel | InsertLight


class ResetModel(Action, frozen=True, tag="reset_model"):
    """Put one model back as it came, with its joints, at rest and with its motors off; its plugins are reset."""

    model: Name


class UndoReset(Action, frozen=True, tag="undo_reset"):
    """Give a model the state before its newest reset, with motors, loads and what its plugins remember."""

    model: Name


ModelAction: TypeAlias = CopyModel | DeleteModel | RestoreModel | ResetModel | UndoReset | DeleteLight | RestoreLight

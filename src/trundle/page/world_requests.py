"""Requests that save a simulated world, or put something into it."""

from typing import Annotated, TypeAlias

import msgspec

from .edit_requests import Action

FileName: TypeAlias = Annotated[str, msgspec.Meta(min_length=1, max_length=300)]


class SaveWorld(Action, frozen=True, tag="save_world"):
    """Write the world as SDF; answered with `file`, or `exists` where a file is in the way."""

    file: FileName | None
    """Path below the folder where the simulation was started; None: answer with the text, `sdf`."""
    replace: bool = False
    """True if a person has agreed to replace the file."""

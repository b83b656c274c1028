"""What the person at the page wants drawn."""

from dataclasses import dataclass


@dataclass(slots=True)
class Display:
    """The toggles of the panel; they outlive a change of scene."""

    visuals: bool = True
    collisions: bool = False
    grid: bool = True
    frames: bool = False
    names: bool = True
    cameras: bool = True
    path: bool = False
    follow: bool = False
    fixed_frame: str = ""

"""A lesson as clients receive it: steps of text, with checks and with parts of the page to look at."""

from typing import Literal, TypeAlias

from msgspec import Struct

from .checks import Check
from .text import Block

PagePart: TypeAlias = Literal[
    "play", "clock", "reset", "world", "displays", "insert", "inspector", "views", "tools", "drive", "cameras",
    "plots", "topics", "log", "graph", "timeline", "compare", "performance", "images", "nodes", "services",
    "parameters", "tf_tree", "reconfigure", "joints", "steering", "joystick", "terminal", "navigation",
    "motion_planning",
]  # fmt: skip
"""Part of the page: of its bar, its side panels, the scene, and the panels of its dock."""


class StatedCheck(Struct, frozen=True, kw_only=True):
    """Check with its sentence."""

    sentence: str
    check: Check


class LessonStep(Struct, frozen=True, kw_only=True):
    """Step of a lesson."""

    title: str
    blocks: tuple[Block, ...]
    checks: tuple[StatedCheck, ...]
    """Checks that are all fulfilled when the step is done; empty: the step is only read."""
    parts: tuple[PagePart, ...]
    """Parts of the page that are marked."""
    models: tuple[str, ...]
    """Models that are outlined in the scene."""


class Lesson(Struct, frozen=True, kw_only=True):
    """Lesson."""

    title: str
    start: str
    """Command that starts the lesson's world and nodes; empty: the lesson needs none."""
    needs: tuple[StatedCheck, ...]
    """Alternative checks: one of them is fulfilled once that command runs."""
    steps: tuple[LessonStep, ...]

"""What the simulation's process and the page's process say to each other, pickled through two pipes.

States and images do not come this way but through mailboxes: they are many, and only the newest counts.
"""

from dataclasses import dataclass

from .content import ViewerScene
from .mailbox import BoxAddress

THUMBNAIL_WIDTH_PX = 640
THUMBNAIL_HEIGHT_PX = 480
"""The largest image that reaches the page; larger ones are thinned to fit."""


MAX_FIGURE_BYTES = 1_000_000
"""Of one drawing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Show:
    """Draw this scene from now on, reading its states and images from these mailboxes."""

    scene: ViewerScene
    state_box: BoxAddress
    image_boxes: tuple[BoxAddress, ...]
    """One per camera."""
    figure_boxes: tuple[BoxAddress, ...] = ()
    """One per figure."""


@dataclass(frozen=True, slots=True)
class Served:
    """The page answers at this address."""

    url: str


@dataclass(frozen=True, slots=True)
class Refused:
    """The address cannot be served."""

    why: str

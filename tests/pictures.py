"""One camera's picture."""

from trundle.render import Intrinsics, Picture, Renderer
from trundle.spatial import Pose


def drawn(
    renderer: Renderer, eye: Pose, lens: Intrinsics, *, depth: bool = False, segmentation: bool = False
) -> Picture:
    """What is seen from there."""
    (picture,) = renderer.render([(eye, lens)], depth=depth, segmentation=segmentation)
    return picture

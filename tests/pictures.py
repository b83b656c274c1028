"""Picture of one camera."""

from trundle.sim.render import Intrinsics, Picture, Renderer
from trundle.spatial import Pose


def drawn(
    renderer: Renderer, eye: Pose, lens: Intrinsics, *, depth: bool = False, segmentation: bool = False
) -> Picture:
    """Return the picture of one camera."""
    (picture,) = renderer.render([(eye, lens)], depth=depth, segmentation=segmentation)
    return picture

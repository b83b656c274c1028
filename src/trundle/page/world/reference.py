"""Recording that a world is compared with, and the differences from it, for the page's client."""

from msgspec import Struct

from trundle.sim.comparison import Difference


class ReferenceInfo(Struct, frozen=True, kw_only=True):
    """Recording that the world is compared with."""

    title: str
    url: str
    """URL of its samples, little-endian: times since its start (samples) f64 [s], positions of the joints
    (samples, joints) f64 [rad or m], poses of the links (samples, links, 7) f32: x y z [m], quaternion x y z w."""
    start: float
    """Time of the world at which it starts [s], with the offset."""
    offset: float
    """Time by which it starts after the run [s]."""
    duration: float
    """[s]"""
    samples: int
    links: tuple[str, ...]
    """`model::link`, of the models that are compared."""
    joints: tuple[str, ...]
    """`model::joint`"""


class Differences(Struct, frozen=True, kw_only=True):
    """Differences of the world from the recording that it is compared with."""

    time: float
    """[s]"""
    rows: tuple[Difference, ...]
    """Models, the farthest first, each by distance and angle; then joints, the largest difference first."""

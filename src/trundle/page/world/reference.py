"""Recording that a world is compared with, and the differences from it, for the page's client."""

from msgspec import Struct

from trundle.sim.comparison import Difference


class ReferenceTopic(Struct, frozen=True, kw_only=True):
    """Numbers of a bag's topic, of messages with the same lengths and names of arrays."""

    topic: str
    samples: int
    paths: tuple[str, ...]
    """`.pose.pose.position.x`, `.position[left_wheel]`"""


class ReferenceInfo(Struct, frozen=True, kw_only=True):
    """Recording that the world or the topics are compared with."""

    title: str
    url: str
    """URL of its samples, little-endian: times since its start (samples) f64 [s], positions of the joints
    (samples, joints) f64 [rad or m], of each topic times (its samples) f64 and numbers (its samples, paths) f64, poses
    of the links (samples, links, 7) f32: x y z [m], quaternion x y z w."""
    start: float
    """Time of the world at which it starts [s], with the offset."""
    offset: float
    """Time by which it starts after the run [s]."""
    duration: float
    """[s]"""
    samples: int
    links: tuple[str, ...]
    """`model::link`, of the models that are compared; of a bag, names of frames."""
    joints: tuple[str, ...]
    """`model::joint`"""
    topics: tuple[ReferenceTopic, ...] = ()
    root: str = ""
    """Frame of the poses of a bag; empty: the world."""


class Differences(Struct, frozen=True, kw_only=True):
    """Differences of the world from the recording that it is compared with."""

    time: float
    """[s]"""
    rows: tuple[Difference, ...]
    """Models or frames, the farthest first, each by distance and angle, of recorded runs also by velocities; then
    joints or numbers, the largest first."""

"""Bones, how they move, and the skin that they carry along."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from .mesh import Mesh

_Array = NDArray[np.float64]
_SMALL = 1e-12


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Bone:
    """One of a skeleton's bones, or a node that bones hang from."""

    name: str
    id: str
    """What animations call it."""
    parent: int
    """Index of the bone it hangs from, which comes before it; −1: none."""
    is_joint: bool
    rest: _Array
    """(4, 4) parent_from_bone [m], where no animation moves it."""


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """How one bone moves: parent_from_bone at some times."""

    times: _Array
    """(T,) [s], rising."""
    positions: _Array
    """(T, 3) [m]"""
    rotations: _Array
    """(T, 4) Unit quaternions wxyz, each in the half of its predecessor."""
    scales: _Array
    """(T, 3) along the bone's axes."""

    def pose_at(self, time_s: float, scale: float) -> _Array:
        """(4, 4) at a time, between two of them as far as it has gone; places are multiplied by `scale`."""
        after = int(np.clip(np.searchsorted(self.times, time_s, side="right"), 1, max(len(self.times) - 1, 1)))
        before, after = after - 1, min(after, len(self.times) - 1)
        span = self.times[after] - self.times[before]
        u = float(np.clip((time_s - self.times[before]) / span, 0.0, 1.0)) if span > 0.0 else 0.0

        def mixed(values: _Array) -> _Array:
            return values[before] + u * (values[after] - values[before])

        pose = np.eye(4)
        pose[:3, :3] = _matrix(_slerp(self.rotations[before], self.rotations[after], u)) * mixed(self.scales)
        pose[:3, 3] = mixed(self.positions) * scale
        return pose


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """An animation of a skeleton, over and over."""

    bones: tuple[Bone, ...]
    tracks: Mapping[int, Track]
    """By the number of the bone."""
    length_s: float = field(init=False)

    def __post_init__(self) -> None:
        ends = [float(track.times[-1]) for track in self.tracks.values()]
        object.__setattr__(self, "length_s", max(ends, default=0.0))

    def time_at(self, distance: float, scale: float) -> float:
        """When the root has come so far along x [m], time and again from its first round's start to its end."""
        track = self.tracks.get(root_of(self.bones))
        way = None if track is None else np.maximum.accumulate(track.positions[:, 0]) * scale
        if track is None or way is None or not way[-1] > 0.0:
            return 0.0
        return float(np.interp(max(distance % float(way[-1]), float(way[0])), way, track.times))

    def poses(self, time_s: float, scale: float) -> dict[int, _Array]:
        """parent_from_bone (4, 4) of each bone that moves; places are multiplied by `scale`."""
        time_s = time_s % self.length_s if self.length_s > 0.0 else 0.0
        return {number: track.pose_at(time_s, scale) for number, track in self.tracks.items()}


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Skin:
    """A mesh whose vertices follow bones."""

    mesh: Mesh
    """As it was bound to the bones."""
    bones: tuple[Bone, ...]
    bound: _Array
    """(N, 4) the mesh's vertices where they were bound, homogeneous [m]."""
    joint_indices: NDArray[np.intp]
    """(A,) the bone of each tie between the skin and a bone."""
    bone_from_skin: _Array
    """(A, 4, 4) where the skin was in that bone when it was tied."""
    influences: NDArray[np.intp]
    """(N, K) the ties that each vertex follows."""
    weights: _Array
    """(N, K) how much; each row's sum is 1."""

    def vertices(self, poses: Mapping[int, _Array]) -> NDArray[np.float32]:
        """(N, 3) the mesh's vertices with the bones at these parent_from_bone (4, 4); others are at rest."""
        skin_from_bone = np.empty((len(self.bones), 4, 4))
        for number, bone in enumerate(self.bones):
            local = poses.get(number, bone.rest)
            skin_from_bone[number] = local if bone.parent < 0 else skin_from_bone[bone.parent] @ local
        moved = skin_from_bone[self.joint_indices] @ self.bone_from_skin
        found = np.zeros((len(self.bound), 3))
        for k in range(self.influences.shape[1]):
            along = np.einsum("nij,nj->ni", moved[self.influences[:, k], :3], self.bound)
            found += self.weights[:, k, None] * along
        return found.astype(np.float32)


def root_of(bones: tuple[Bone, ...]) -> int:
    """The number of the first bone that is a joint."""
    return next((number for number, bone in enumerate(bones) if bone.is_joint), 0)


def match_bones(skin: tuple[Bone, ...], motion: tuple[Bone, ...]) -> dict[int, int] | None:
    """The bone of a skin for each bone of a motion: by name, else by their order where they branch alike.

    None: the skeletons do not fit.
    """
    numbers = {bone.name: number for number, bone in enumerate(skin)}
    moving = [number for number, bone in enumerate(motion) if bone.is_joint]
    if all(motion[number].name in numbers for number in moving):
        return {number: numbers[motion[number].name] for number in moving}
    still = [number for number, bone in enumerate(skin) if bone.is_joint]
    if _branches(skin, still) != _branches(motion, moving):
        return None
    return dict(zip(moving, still, strict=True))


def track_from_poses(times: _Array, poses: _Array) -> Track:
    """A track through parent_from_bone (T, 4, 4), which may stretch but not shear."""
    stretches = np.maximum(np.linalg.norm(poses[:, :3, :3], axis=1), _SMALL)
    turns = np.array([_quaternion(pose[:3, :3] / stretch) for pose, stretch in zip(poses, stretches, strict=True)])
    for i in range(1, len(turns)):
        if turns[i] @ turns[i - 1] < 0.0:
            turns[i] = -turns[i]
    return Track(times, poses[:, :3, 3].copy(), turns, stretches)


def _branches(bones: tuple[Bone, ...], joints: list[int]) -> list[int]:
    return [sum(bones[each].parent == number for each in joints) for number in joints]


def _slerp(a: _Array, b: _Array, u: float) -> _Array:
    angle = float(np.arccos(np.clip(a @ b, -1.0, 1.0)))
    if angle < 1e-6:
        return a
    return (np.sin((1.0 - u) * angle) * a + np.sin(u * angle) * b) / np.sin(angle)


def _matrix(q: _Array) -> _Array:
    w, x, y, z = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def _quaternion(m: _Array) -> _Array:
    """Of a rotation, from the largest of its four parts (Shepperd)."""
    trace = np.trace(m)
    largest = int(np.argmax([trace, m[0, 0], m[1, 1], m[2, 2]]))
    if largest == 0:
        q = np.array([1 + trace, m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]])
    else:
        i = largest - 1
        j, k = (i + 1) % 3, (i + 2) % 3
        q = np.zeros(4)
        q[0] = m[k, j] - m[j, k]
        q[1 + i] = 1 + m[i, i] - m[j, j] - m[k, k]
        q[1 + j] = m[j, i] + m[i, j]
        q[1 + k] = m[k, i] + m[i, k]
    return q / np.linalg.norm(q)

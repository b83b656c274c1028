"""Skeletons, their animations, and skins."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from trundle.spatial import Quaternion, matrix_from_quaternion, quaternion_from_matrix, slerp

from .mesh import Mesh

_Array = NDArray[np.float64]
_SMALL = 1e-12


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Bone:
    """Bone of a skeleton, or a parent node of bones."""

    name: str
    id: str
    """Id used by animations."""
    parent: int
    """Index of the parent bone, which comes before it; −1: none."""
    is_joint: bool
    rest: _Array
    """(4, 4) parent_from_bone in the rest pose [m]."""


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """Animation of one bone: parent_from_bone at key times."""

    times: _Array
    """(T,) key times [s], ascending."""
    positions: _Array
    """(T, 3) positions [m]."""
    rotations: tuple[Quaternion, ...]
    """T unit quaternions."""
    scales: _Array
    """(T, 3) scales along the bone's axes."""

    def pose_at(self, time_s: float, scale: float) -> _Array:
        """Return the interpolated pose (4, 4) at a time, with positions multiplied by `scale`."""
        last = len(self.times) - 1
        after = min(max(int(self.times.searchsorted(time_s, side="right")), 1), max(last, 1))
        before, after = after - 1, min(after, last)
        span = float(self.times[after] - self.times[before])
        u = min(max((time_s - float(self.times[before])) / span, 0.0), 1.0) if span > 0.0 else 0.0

        def mixed(values: _Array) -> _Array:
            return values[before] + u * (values[after] - values[before])

        turn = slerp(self.rotations[before], self.rotations[after], u)
        pose = np.eye(4)
        pose[:3, :3] = matrix_from_quaternion(turn) * mixed(self.scales)
        pose[:3, 3] = mixed(self.positions) * scale
        return pose


@dataclass(frozen=True, slots=True, eq=False)
class Motion:
    """Looped animation of a skeleton."""

    bones: tuple[Bone, ...]
    tracks: Mapping[int, Track]
    """Bone index → track."""
    length_s: float = field(init=False)

    def __post_init__(self) -> None:
        ends = [float(track.times[-1]) for track in self.tracks.values()]
        object.__setattr__(self, "length_s", max(ends, default=0.0))

    def time_at(self, distance: float, scale: float) -> float:
        """Return the time at which the root has moved a distance along x [m], modulo the animation's total distance."""
        track = self.tracks.get(root_of(self.bones))
        travelled = None if track is None else np.maximum.accumulate(track.positions[:, 0]) * scale
        if track is None or travelled is None or not travelled[-1] > 0.0:
            return 0.0
        return float(np.interp(max(distance % float(travelled[-1]), float(travelled[0])), travelled, track.times))

    def poses(self, time_s: float, scale: float) -> dict[int, _Array]:
        """Return parent_from_bone (4, 4) of each animated bone, with positions multiplied by `scale`."""
        time_s = time_s % self.length_s if self.length_s > 0.0 else 0.0
        return {number: track.pose_at(time_s, scale) for number, track in self.tracks.items()}


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Skin:
    """Mesh deformed by bones (linear blend skinning)."""

    mesh: Mesh
    """Mesh in the bind pose."""
    bones: tuple[Bone, ...]
    bound: _Array
    """(N, 4) vertices in the bind pose, homogeneous [m]."""
    joint_indices: NDArray[np.intp]
    """(A,) bone index of each bind matrix."""
    bone_from_skin: _Array
    """(A, 4, 4) inverse bind matrices."""
    influences: NDArray[np.intp]
    """(N, K) indices of the bind matrices of each vertex."""
    weights: _Array
    """(N, K) weights; each row's sum is 1."""

    def joint_poses(self, poses: Mapping[int, _Array]) -> _Array:
        """Return skin_from_bone (A, 4, 4) of each bind matrix, for parent_from_bone (4, 4) of some bones.

        The others are in the rest pose.
        """
        skin_from_bone = np.empty((len(self.bones), 4, 4))
        for number, bone in enumerate(self.bones):
            local = poses.get(number, bone.rest)
            skin_from_bone[number] = local if bone.parent < 0 else skin_from_bone[bone.parent] @ local
        return skin_from_bone[self.joint_indices]

    def vertices(self, poses: Mapping[int, _Array]) -> NDArray[np.float32]:
        """Return the (N, 3) vertices for bone poses as in `joint_poses`."""
        moved = self.joint_poses(poses) @ self.bone_from_skin
        blended = np.zeros((len(self.bound), 3))
        for k in range(self.influences.shape[1]):
            along = np.einsum("nij,nj->ni", moved[self.influences[:, k], :3], self.bound)
            blended += self.weights[:, k, None] * along
        return blended.astype(np.float32)


def root_of(bones: tuple[Bone, ...]) -> int:
    """Return the index of the first bone that is a joint."""
    return next((number for number, bone in enumerate(bones) if bone.is_joint), 0)


def match_bones(skin: tuple[Bone, ...], motion: tuple[Bone, ...]) -> dict[int, int] | None:
    """Return the skin's bone for each bone of a motion: by name, else by order if the skeletons have equal branches.

    None if the skeletons do not match.
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
    """Return a track through parent_from_bone (T, 4, 4), with scale but without shear."""
    stretches = np.maximum(np.linalg.norm(poses[:, :3, :3], axis=1), _SMALL)
    turns = tuple(
        quaternion_from_matrix(pose[:3, :3] / stretch) for pose, stretch in zip(poses, stretches, strict=True)
    )
    return Track(times, poses[:, :3, 3].copy(), turns, stretches)


def _branches(bones: tuple[Bone, ...], joints: list[int]) -> list[int]:
    return [sum(bones[joint].parent == number for joint in joints) for number in joints]

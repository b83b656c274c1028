"""Reader of BVH motion capture files: joint offsets, and joint angles per frame."""

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .mesh import MeshError
from .skeleton import Bone, Motion, track_from_poses

_Array = NDArray[np.float64]
_MAX_BONES, _MAX_FRAMES = 1000, 100_000
_AXES = "XYZ"


def read_bvh(text: str) -> Motion:
    """Read a file in its own units and axes, as Gazebo does; a joint's rotations apply in channel order.

    Raises:
        MeshError: not a BVH file, or truncated.
    """
    words = iter(text.split())
    try:
        if next(words) != "HIERARCHY":
            raise MeshError("does not begin with HIERARCHY")
        bones, channels = _hierarchy(words)
        count, step_s = _heading(words)
        numbers = np.array([float(word) for word in words])
    except StopIteration:
        raise MeshError("ends too early") from None
    except ValueError as error:
        raise MeshError(str(error)) from None
    width = sum(map(len, channels))
    count = min(count, len(numbers) // max(width, 1), _MAX_FRAMES)
    are_finite = all(np.isfinite(values).all() for values in (step_s, numbers, *(bone.rest for bone in bones)))
    if not (count > 0 and width > 0 and step_s > 0.0 and are_finite):
        raise MeshError("contains no motion")
    frames = np.split(
        numbers[: count * width].reshape(count, width), np.cumsum([len(c) for c in channels])[:-1], axis=1
    )
    times = np.arange(count, dtype=np.float64) * np.float64(step_s)
    poses = (_poses(*arguments) for arguments in zip(bones, channels, frames, strict=True))
    return Motion(bones, {number: track_from_poses(times, pose) for number, pose in enumerate(poses)})


def _hierarchy(words: Iterator[str]) -> tuple[tuple[Bone, ...], list[list[str]]]:
    """Return the joints, parents first, and the channels of each; end sites are not joints."""
    bones: list[Bone] = []
    channels: list[list[str]] = []
    enclosing: list[int] = []
    """Enclosing joints; −1 for an end site."""
    while (word := next(words)) != "MOTION":
        match word:
            case "ROOT" | "JOINT":
                if len(bones) >= _MAX_BONES:
                    raise MeshError(f"more than {_MAX_BONES} joints")
                name = next(words)
                bones.append(
                    Bone(name=name, id=name, parent=enclosing[-1] if enclosing else -1, is_joint=True, rest=np.eye(4))
                )
                channels.append([])
                enclosing.append(len(bones) - 1)
            case "End":
                next(words)
                enclosing.append(-1)
            case "}":
                if not enclosing:
                    raise MeshError("a '}' too many")
                enclosing.pop()
            case "OFFSET":
                offset = [float(next(words)) for _ in range(3)]
                if enclosing and enclosing[-1] >= 0:
                    bones[enclosing[-1]].rest[:3, 3] = offset
            case "CHANNELS":
                names = [next(words) for _ in range(min(int(next(words)), 6))]
                if enclosing and enclosing[-1] >= 0:
                    channels[enclosing[-1]] += names
            case _:
                pass  # a line with a brace
    return tuple(bones), channels


def _heading(words: Iterator[str]) -> tuple[int, float]:
    """Return the number of frames and the frame time [s]."""
    if next(words) != "Frames:":
        raise MeshError("no 'Frames:' after MOTION")
    count = int(next(words))
    if [next(words), next(words)] != ["Frame", "Time:"]:
        raise MeshError("no 'Frame Time:'")
    return count, float(next(words))


def _poses(bone: Bone, channels: list[str], values: _Array) -> _Array:
    """Return (frames, 4, 4) parent_from_bone."""
    poses = np.repeat(bone.rest[None], len(values), axis=0)
    for channel, column in zip(channels, values.T, strict=True):
        axis = _AXES.find(channel[:1])
        if axis < 0:
            continue
        if channel[1:] == "position":
            poses[:, axis, 3] = column
        elif channel[1:] == "rotation":
            angles = column * (math.pi / 180.0)
            turn = np.repeat(np.eye(4)[None], len(values), axis=0)
            i, j = (axis + 1) % 3, (axis + 2) % 3
            turn[:, i, i] = turn[:, j, j] = np.cos(angles)
            turn[:, j, i] = np.sin(angles)
            turn[:, i, j] = -turn[:, j, i]
            poses = poses @ turn
    return poses

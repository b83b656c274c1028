"""Lloyd's k-means clustering."""

import random
from collections.abc import Sequence

from trundle.spatial import Vector3

_MAX_ROUNDS = 100


def kmeans_centers(points: Sequence[Vector3], count: int, chance: random.Random) -> list[Vector3]:
    """Return cluster centres that are spread as evenly as the points.

    Args:
        points: (N, 3); reused cyclically if fewer than `count`.
        count: number of clusters.
        chance: random generator of the initial centres.
    """
    import numpy as np

    cloud = np.array(points, dtype=np.float64).reshape(-1, 3)
    if len(cloud) <= count:
        return [points[number % len(points)] for number in range(count)]
    middles = cloud[chance.sample(range(len(cloud)), count)]
    nearest = np.zeros(0, dtype=np.int64)
    for _ in range(_MAX_ROUNDS):
        # |p − m|² without |p|², which is the same for every centre
        distances = (middles**2).sum(axis=1) - 2.0 * cloud @ middles.T
        found = distances.argmin(axis=1)
        if np.array_equal(found, nearest):
            break
        nearest = found
        sizes = np.bincount(nearest, minlength=count)
        sums = np.stack([np.bincount(nearest, weights=cloud[:, axis], minlength=count) for axis in range(3)], axis=1)
        middles = np.where(sizes[:, None] > 0, sums / np.maximum(sizes, 1)[:, None], middles)
    return [(x, y, z) for x, y, z in middles.tolist()]

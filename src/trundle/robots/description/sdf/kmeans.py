"""Lloyd's k-means clustering."""

import random
from collections.abc import Sequence

from trundle.spatial import Vector3

_MAX_ROUNDS = 100


def kmeans_centers(points: Sequence[Vector3], count: int, rng: random.Random) -> list[Vector3]:
    """Return the centres of clusters of points.

    Args:
        points: (N, 3) points; repeated if fewer than `count`.
        count: number of clusters.
        rng: random number generator for the initial centres.
    """
    import numpy as np

    cloud = np.array(points, dtype=np.float64).reshape(-1, 3)
    if len(cloud) <= count:
        return [points[number % len(points)] for number in range(count)]
    centers = cloud[rng.sample(range(len(cloud)), count)]
    nearest = np.zeros(0, dtype=np.int64)
    for _ in range(_MAX_ROUNDS):
        # |p − m|² without |p|², which is the same for every centre
        distances = (centers**2).sum(axis=1) - 2.0 * cloud @ centers.T
        assigned = distances.argmin(axis=1)
        if np.array_equal(assigned, nearest):
            break
        nearest = assigned
        sizes = np.bincount(nearest, minlength=count)
        sums = np.stack([np.bincount(nearest, weights=cloud[:, axis], minlength=count) for axis in range(3)], axis=1)
        centers = np.where(sizes[:, None] > 0, sums / np.maximum(sizes, 1)[:, None], centers)
    return [(x, y, z) for x, y, z in centers.tolist()]

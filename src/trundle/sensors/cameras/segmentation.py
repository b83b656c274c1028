"""Segmentation cameras: what each pixel shows."""

import colorsys

import numpy as np
from numpy.typing import NDArray

from trundle.simulation import Snapshot

from .camera import CameraReading, CameraSensor
from .scene import CameraScene

INSTANCES = 1 << 16
"""What a label is multiplied by where things of one label are told apart."""
_GOLDEN = 0.6180339887498949
"""Hues that many golden sections apart are never close to one another."""


class SegmentationCameraSensor(CameraSensor):
    """Sees the labels that gz's Label plugin gave; what has none is background.

    Semantic pictures hold labels; panoptic ones also number the models that share a label, from 1 on.
    """

    needs_segmentation = True
    sees_labels = True

    def measure(self, snapshot: Snapshot) -> CameraReading:
        """See what is where."""
        shapes = self.render(snapshot).segmentation
        assert shapes is not None
        values = instance_labels(self.scene) if self.optics.panoptic else self.scene.labels
        kinds, kind_of = np.unique(values, return_inverse=True)
        colours = np.array([_colour(int(value)) for value in kinds], dtype=np.uint8)
        return CameraReading(time_ns=snapshot.time_ns, rgb=colours[kind_of[shapes]], labels=values[shapes])


def instance_labels(scene: CameraScene) -> NDArray[np.int32]:
    """By shape: 65536 times its label, plus the number of its model among those of that label."""
    values = np.zeros(len(scene.labels), dtype=np.int32)
    for label in np.unique(scene.labels[scene.labels > 0]):
        of_label = scene.labels == label
        _, number = np.unique(scene.models[of_label], return_inverse=True)
        values[of_label] = int(label) * INSTANCES + number + 1
    return values


def _colour(value: int) -> tuple[int, int, int]:
    """Black for the background, else a hue of its own."""
    if value == 0:
        return (0, 0, 0)
    label, instance = divmod(value, INSTANCES) if value >= INSTANCES else (value, 0)
    r, g, b = colorsys.hsv_to_rgb((label * _GOLDEN) % 1.0, 1.0 - 0.5 * ((instance * _GOLDEN) % 1.0), 1.0)
    return round(255 * r), round(255 * g), round(255 * b)

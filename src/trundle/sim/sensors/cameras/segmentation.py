"""Segmentation cameras: a label per pixel."""

import colorsys

import numpy as np
from numpy.typing import NDArray

from trundle.sim.simulation import Snapshot

from .camera import CameraReading, CameraSensor
from .scene import CameraScene

INSTANCES = 1 << 16
"""Factor of the label in a panoptic value."""
_GOLDEN = 0.6180339887498949
"""Golden ratio step of hues, which makes the colors of labels distinct."""


class SegmentationCameraSensor(CameraSensor):
    """Camera for the labels of gz's Label plugin; unlabelled shapes are background.

    Semantic images hold labels; panoptic ones also number the models of each label from 1.
    """

    needs_segmentation = True
    sees_labels = True

    def measure(self, snapshot: Snapshot) -> CameraReading:
        """Render the labels."""
        shapes = self.render(snapshot).segmentation
        assert shapes is not None
        values = instance_labels(self.scene) if self.optics.panoptic else self.scene.labels
        unique, index = np.unique(values, return_inverse=True)
        colors = np.array([_color(int(value)) for value in unique], dtype=np.uint8)
        return CameraReading(time_ns=snapshot.time_ns, rgb=colors[index[shapes]], labels=values[shapes])


def instance_labels(scene: CameraScene) -> NDArray[np.int32]:
    """Return 65536 · label + instance number for each shape, numbering the models of each label from 1."""
    values = np.zeros(len(scene.labels), dtype=np.int32)
    for label in np.unique(scene.labels[scene.labels > 0]):
        of_label = scene.labels == label
        _, number = np.unique(scene.models[of_label], return_inverse=True)
        values[of_label] = int(label) * INSTANCES + number + 1
    return values


def _color(value: int) -> tuple[int, int, int]:
    """Return black for the background, else a distinct hue."""
    if value == 0:
        return (0, 0, 0)
    label, instance = divmod(value, INSTANCES) if value >= INSTANCES else (value, 0)
    r, g, b = colorsys.hsv_to_rgb((label * _GOLDEN) % 1.0, 1.0 - 0.5 * ((instance * _GOLDEN) % 1.0), 1.0)
    return round(255 * r), round(255 * g), round(255 * b)

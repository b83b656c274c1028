"""Digest of all inputs of a dataset."""

from pathlib import Path

from trundle.studies.datasets import PictureMaker

from ..input_digest import input_digest


def dataset_digest(maker: PictureMaker) -> str:
    """Return a digest of everything that may change a picture; the number of pictures is not part of it."""
    text = "\n".join(line for line in maker.plan.text.splitlines() if not line.startswith("count:"))
    textures = [texture for texture in maker.looks.textures if isinstance(texture, Path)]
    return input_digest([text], [maker.world], textures)

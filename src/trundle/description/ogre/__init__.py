"""Colours and textures from Ogre's material scripts, which SDF's <material><script> names."""

from .find import find_material

__all__ = ["find_material"]

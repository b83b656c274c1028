"""Readers of COLLADA scenes, skeletons, animations and skins."""

"""COLLADA files: scene, skeletons, animations and skins."""

"""Meshes as convex pieces, which is all that MuJoCo's contacts know."""

"""Convex decomposition of meshes: MuJoCo's contacts support convex shapes only."""

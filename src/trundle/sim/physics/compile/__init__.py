"""Compilation of a World to a MuJoCo model: bodies, joints, geoms, contact pairs and solver settings."""

"""Builders of worlds and models in code, with SDF's names and defaults."""

"""Worlds and models built in code, with SDF's names and defaults."""

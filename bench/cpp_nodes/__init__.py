"""Compiled C++ of checked-out repositories: which targets compile, start, and are loaded."""

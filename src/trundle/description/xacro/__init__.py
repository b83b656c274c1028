"""Xacro expanded with the official package."""

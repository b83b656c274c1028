"""Expansion of xacro by the official package."""

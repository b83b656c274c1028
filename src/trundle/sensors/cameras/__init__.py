"""Cameras of every kind: a snapshot becomes a picture."""

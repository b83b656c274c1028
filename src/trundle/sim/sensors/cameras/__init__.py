"""Cameras of every kind: snapshots in, images out."""

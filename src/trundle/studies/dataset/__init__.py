"""Datasets for vision: a plan's world, its pictures in many processes, the files."""

"""Composition root: starts, paces and stops everything; the one room that imports all others.

Each task is a module of its own (`run`, `launch`, `check`, …) and nothing is imported here: `check` must not load all
that `launch` needs.
"""

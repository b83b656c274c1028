"""The composition root: starts, paces and stops everything; alone knows everyone.

Each task is a module of its own (`run`, `launch`, `check`, …) and nothing is imported here: whoever checks a file must
not wait for all that a launch needs.
"""

"""Plugins of RotorS, by file name."""

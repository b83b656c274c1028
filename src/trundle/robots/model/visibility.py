"""Visibility masks: a sensor draws a visual when its mask and the visual's flags share a bit."""

EVERY_BIT = 0xFFFFFFFF

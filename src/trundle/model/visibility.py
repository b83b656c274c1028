"""Who sees what: a sensor's mask and a visual's flags have to share a bit."""

EVERY_BIT = 0xFFFFFFFF

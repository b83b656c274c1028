"""Driving by a dead man's switch."""

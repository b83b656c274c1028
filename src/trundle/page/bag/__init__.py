"""Playback of a bag's messages as topics."""

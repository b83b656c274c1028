"""Requests of clients: edits of the world and of a draft, saving, playback."""

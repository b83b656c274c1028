"""Saving of a world that changed during simulation, as edits of its original XML."""

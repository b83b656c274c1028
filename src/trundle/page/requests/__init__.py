"""Requests of clients: edits of the world, of a model, and the rest."""

"""Saving of a world that was changed while it ran, into the XML that it came from."""

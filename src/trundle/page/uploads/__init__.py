"""Models uploaded by browsers."""

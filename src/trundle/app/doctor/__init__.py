"""`trundle doctor` and `roswtf`: checks of a machine and a graph."""

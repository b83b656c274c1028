"""`trundle doctor` and `roswtf`: what a machine and a graph have and lack."""

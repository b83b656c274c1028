"""Page of a simulation: the manifest of its world, its files, and the feed of its state."""

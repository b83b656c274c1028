"""Steps a compiled world, reads and writes its state."""

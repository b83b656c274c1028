"""Robot and world files, and what they name: read into structures."""

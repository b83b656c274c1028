"""Robot and world files, and the files that they name, read into structs."""

"""A world or a model as SDF 1.11."""

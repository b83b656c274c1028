"""Writer of SDF 1.11."""

"""Many runs of a world: sweeps and datasets."""

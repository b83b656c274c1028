"""Batches of worlds on a GPU, by MuJoCo on NVIDIA Warp."""

"""Models that a browser sends."""

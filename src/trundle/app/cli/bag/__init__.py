"""Record, play, describe and edit bags, as rosbag does."""

from .command import EXAMPLES, configure, main

__all__ = ["EXAMPLES", "configure", "main"]

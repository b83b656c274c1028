"""Bags: recorded, played, read and written, as ROS 1 bags and as MCAP."""

from .bag import BagConnection, BagError, BagMessage, BagReader, BagWriter, Chunk, UnindexedBagError
from .files import create_bag, open_bag, recovered
from .play import Player, PlayOptions
from .record import Recorder, RecordOptions
from .steps import StepRecorder

__all__ = [
    "BagConnection",
    "BagError",
    "BagMessage",
    "BagReader",
    "BagWriter",
    "Chunk",
    "PlayOptions",
    "Player",
    "RecordOptions",
    "Recorder",
    "StepRecorder",
    "UnindexedBagError",
    "create_bag",
    "open_bag",
    "recovered",
]

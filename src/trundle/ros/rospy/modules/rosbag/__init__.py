"""Bags: files of messages."""

from .bag import Bag, Compression
from .bag_tuples import BagMessage, BagMessageWithConnectionHeader
from .exceptions import (
    ROSBagEncryptException,
    ROSBagEncryptNotSupportedException,
    ROSBagException,
    ROSBagFormatException,
    ROSBagUnindexedException,
)

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from collections.abc import Sequence
    from typing import NoReturn

__all__ = [
    "Bag",
    "BagMessage",
    "BagMessageWithConnectionHeader",
    "Compression",
    "ROSBagEncryptException",
    "ROSBagEncryptNotSupportedException",
    "ROSBagException",
    "ROSBagFormatException",
    "ROSBagUnindexedException",
    "rosbagmain",
]


def rosbagmain(argv: "Sequence[str] | None" = None) -> "NoReturn":
    """Run the command rosbag with its arguments; default: this process's arguments."""
    import sys

    from trundle.app.cli.main import main

    sys.exit(main(["bag", *(sys.argv if argv is None else argv)[1:]]))

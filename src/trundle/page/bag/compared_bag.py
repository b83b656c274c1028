"""Bag that a user names to compare a page's topics with."""

from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Source
from trundle.ros import is_bag, open_bag

from ..wire import BagReferenceFile


def compared_bag(file: Path) -> BagReferenceFile | None:
    """Return the bag of a file after checking it, before a run starts; None: the file is no bag.

    Raises:
        BagError: the file cannot be read, or its index is damaged.
        DescriptionError: the bag is empty.
    """
    if not is_bag(file):
        return None
    with open_bag(file) as bag:
        if not any(bag.counts):
            raise DescriptionError(Source(str(file)), "nothing was recorded")
    return BagReferenceFile.of(file)

"""Replacement of DOM nodes in linear time."""

from itertools import pairwise
from typing import Any

_INDEX = "trundle_index"
"""Attribute of a parent: where its last child was replaced."""


def replace_node(node: Any, by: Any, content_only: bool = False) -> None:
    """Replace a node by others, or by their children; the package's own takes the square of their number.

    Args:
        node: is removed from its parent.
        by: a node without a parent, several, or None.
        content_only: insert the children of `by`.
    """
    given: list[Any] = by if isinstance(by, list) else [] if by is None else [by]
    found = [child for each in given for child in each.childNodes] if content_only else list(given)
    if content_only:
        for each in given:
            each.childNodes.clear()
    parent, before, after = node.parentNode, node.previousSibling, node.nextSibling
    siblings = parent.childNodes
    index = _index(siblings, node, getattr(parent, _INDEX, 0))
    setattr(parent, _INDEX, index)
    siblings[index : index + 1] = found
    node.parentNode = node.previousSibling = node.nextSibling = None
    for each in found:
        each.parentNode = parent
    chain = [before, *found, after]
    for one, next_one in pairwise(chain):
        if one is not None:
            one.nextSibling = next_one
        if next_one is not None:
            next_one.previousSibling = one


def _index(siblings: list[Any], node: Any, start: int) -> int:
    """Return a node's index; nodes are replaced from first to last."""
    try:
        return siblings.index(node, start)
    except ValueError:
        return siblings.index(node)

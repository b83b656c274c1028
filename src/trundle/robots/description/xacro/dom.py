"""Replacement of DOM nodes in linear time."""

from itertools import pairwise
from typing import Any

_INDEX = "trundle_index"
"""Attribute of a parent: index of the last replaced child."""


def replace_node(node: Any, by: Any, content_only: bool = False) -> None:
    """Replace a node by others, or by their children, in linear time; the package's function takes quadratic time.

    Args:
        node: node to remove from its parent.
        by: node without a parent, a list of them, or None.
        content_only: insert the children of `by`.
    """
    nodes: list[Any] = by if isinstance(by, list) else [] if by is None else [by]
    inserted = [child for new in nodes for child in new.childNodes] if content_only else list(nodes)
    if content_only:
        for new in nodes:
            new.childNodes.clear()
    parent, before, after = node.parentNode, node.previousSibling, node.nextSibling
    siblings = parent.childNodes
    index = _index(siblings, node, getattr(parent, _INDEX, 0))
    setattr(parent, _INDEX, index)
    siblings[index : index + 1] = inserted
    node.parentNode = node.previousSibling = node.nextSibling = None
    for new in inserted:
        new.parentNode = parent
    chain = [before, *inserted, after]
    for current, following in pairwise(chain):
        if current is not None:
            current.nextSibling = following
        if following is not None:
            following.previousSibling = current


def _index(siblings: list[Any], node: Any, start: int) -> int:
    """Return a node's index, searched first after the last replaced one."""
    try:
        return siblings.index(node, start)
    except ValueError:
        return siblings.index(node)

"""Graphs of nodes and topics, and curves over time: as text for a terminal, as SVG pictures."""

from .curves import Curve, curves_svg, curves_text
from .graph import Drawing, Item, graph_dot, graph_of, graph_svg

__all__ = [
    "Curve",
    "Drawing",
    "Item",
    "curves_svg",
    "curves_text",
    "graph_dot",
    "graph_of",
    "graph_svg",
]

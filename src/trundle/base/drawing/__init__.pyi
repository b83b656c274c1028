from .curves import Curve as Curve, curves_svg as curves_svg, curves_text as curves_text
from .graph import (
    Item as Item,
    NodeGraph as NodeGraph,
    graph_dot as graph_dot,
    graph_svg as graph_svg,
    node_graph as node_graph,
)

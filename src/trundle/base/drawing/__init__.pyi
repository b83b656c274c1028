from .curves import Curve as Curve
from .curves import curves_svg as curves_svg
from .curves import curves_text as curves_text
from .graph import Item as Item
from .graph import NodeGraph as NodeGraph
from .graph import graph_dot as graph_dot
from .graph import graph_svg as graph_svg
from .graph import node_graph as node_graph

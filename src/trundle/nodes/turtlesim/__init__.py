"""turtlesim: turtles that draw, and the nodes of its tutorials."""

from .draw_square import DrawSquare
from .mimic import Mimic
from .simulator import TurtleSim
from .teleop_key import TurtleTeleopKey

__all__ = ["DrawSquare", "Mimic", "TurtleSim", "TurtleTeleopKey"]

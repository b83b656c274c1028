from .draw_square import DrawSquare as DrawSquare
from .mimic import Mimic as Mimic
from .simulator import TurtleSim as TurtleSim
from .teleop_key import TurtleTeleopKey as TurtleTeleopKey

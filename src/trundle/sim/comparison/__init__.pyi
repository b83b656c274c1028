from .comparison import Comparison as Comparison
from .difference import Difference as Difference
from .trajectory import Trajectory as Trajectory

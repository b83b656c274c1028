from .comparison import Comparison as Comparison
from .difference import Difference as Difference
from .trajectory import Trajectory as Trajectory, ascending_rows as ascending_rows, first_links as first_links

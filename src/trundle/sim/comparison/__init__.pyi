from .comparison import Comparison as Comparison
from .difference import Difference as Difference, Quantity as Quantity
from .finite_differences import slopes as slopes, velocities as velocities
from .number_comparison import NumberComparison as NumberComparison, Numbers as Numbers
from .trajectory import Trajectory as Trajectory, ascending_rows as ascending_rows, first_links as first_links

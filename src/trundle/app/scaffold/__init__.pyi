from .scaffold import ROBOTS as ROBOTS
from .scaffold import Scaffold as Scaffold
from .scaffold import next_steps as next_steps
from .scaffold import scaffolds as scaffolds
from .scaffold import write_scaffold as write_scaffold

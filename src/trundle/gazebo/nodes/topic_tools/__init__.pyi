from .drop import Drop as Drop
from .mux import Mux as Mux
from .relay import Relay as Relay
from .throttle import Throttle as Throttle
from .transform import Transform as Transform

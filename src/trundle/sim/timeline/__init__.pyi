from .keyframes import DEFAULT_LIMIT_BYTES as DEFAULT_LIMIT_BYTES, Timeline as Timeline
from .saved_objects import SavedObjects as SavedObjects
from .saved_plugins import save_plugins as save_plugins

from .timeline import DEFAULT_LIMIT_BYTES as DEFAULT_LIMIT_BYTES
from .timeline import Timeline as Timeline

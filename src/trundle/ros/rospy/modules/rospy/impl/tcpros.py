"""Size of buffers, at the path that programs import it from."""

from ..topics import DEFAULT_BUFF_SIZE as DEFAULT_BUFF_SIZE

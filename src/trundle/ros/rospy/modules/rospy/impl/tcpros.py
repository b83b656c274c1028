"""Size of buffers, where programs import it from."""

from ..topics import DEFAULT_BUFF_SIZE as DEFAULT_BUFF_SIZE

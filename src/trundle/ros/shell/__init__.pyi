from .activation import write_activation as write_activation
from .session import run_shell as run_shell

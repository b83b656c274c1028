from .scaffold_files import (
    ROBOTS as ROBOTS,
    Scaffold as Scaffold,
    next_steps as next_steps,
    scaffolds as scaffolds,
    write_scaffold as write_scaffold,
)

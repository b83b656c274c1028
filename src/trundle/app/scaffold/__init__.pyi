from .scaffold_files import (
    ROBOTS as ROBOTS,
    Scaffold as Scaffold,
    append_target as append_target,
    next_steps as next_steps,
    scaffolds as scaffolds,
    write_scaffold as write_scaffold,
)

from .collision_pairs import TRIALS as TRIALS, find_disabled_pairs as find_disabled_pairs
from .config_package import (
    DescriptionSource as DescriptionSource,
    moveit_config as moveit_config,
    write_moveit_config as write_moveit_config,
)
from .group_finder import (
    FoundArm as FoundArm,
    FoundGripper as FoundGripper,
    FoundGroups as FoundGroups,
    find_groups as find_groups,
)

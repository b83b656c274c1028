from .auto_inertia import enclosed_volume as enclosed_volume, uniform_inertial as uniform_inertial
from .context import DEEPEST as DEEPEST, Context as Context
from .extra_joint import read_extra_joint as read_extra_joint
from .gazebo_materials import GAZEBO_MATERIALS as GAZEBO_MATERIALS
from .required import name_missing_attributes as name_missing_attributes
from .sdf_1_0 import rewrite_old_style as rewrite_old_style
from .version import read_version as read_version
from .world import read_root as read_root

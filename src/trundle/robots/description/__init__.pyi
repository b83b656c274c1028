from .builder.joint import Joint as Joint
from .builder.link import Link as Link
from .builder.model import Model as Model
from .builder.world import World as World
from .loaded import LoadedDescription as LoadedDescription
from .read import load as load, load_text as load_text, load_urdf as load_urdf
from .saving.model_document import copy_model as copy_model, move_uris as move_uris
from .saving.save import SavedWorld as SavedWorld, save_world as save_world
from .sdf import (
    GAZEBO_MATERIALS as GAZEBO_MATERIALS,
    enclosed_volume as enclosed_volume,
    read_extra_joint as read_extra_joint,
    uniform_inertial as uniform_inertial,
)
from .writing import UriOf as UriOf, write_sdf as write_sdf, write_urdf as write_urdf, written_uri as written_uri
from .xacro.expand import expand_xacro as expand_xacro

"""Model becomes text: SDF and URDF."""

from .files import UriOf, written_uri
from .sdf import write_sdf
from .urdf import write_urdf

__all__ = ["UriOf", "write_sdf", "write_urdf", "written_uri"]

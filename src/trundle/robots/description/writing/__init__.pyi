from .files import UriOf as UriOf, written_uri as written_uri
from .sdf.writer import write_sdf as write_sdf
from .urdf import write_urdf as write_urdf

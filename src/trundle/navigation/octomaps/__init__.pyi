from .octomap_saver import OctomapSaver as OctomapSaver
from .octomap_server import OctomapServer as OctomapServer, OctomapServerStatic as OctomapServerStatic

from .explore import Explore as Explore
from .explore_client import ExploreClient as ExploreClient
from .explore_server import ExploreServer as ExploreServer

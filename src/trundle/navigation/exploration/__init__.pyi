from .explore import Explore as Explore
from .explore_client import ExploreClient as ExploreClient
from .explore_server import ExploreServer as ExploreServer
from .frontier_detector import FrontierDetector as FrontierDetector
from .rrt_assigner import RrtAssigner as RrtAssigner
from .rrt_detector import GlobalRrtDetector as GlobalRrtDetector, LocalRrtDetector as LocalRrtDetector
from .rrt_filter import RrtFilter as RrtFilter

from .follow_waypoints import FollowWaypoints as FollowWaypoints
from .waypoint_provider import WaypointProvider as WaypointProvider
from .waypoints_navi import WaypointsNavi as WaypointsNavi

"""Clock selection by /use_sim_time."""

from .clock import Clock, SimClock, WallClock, to_nsec
from .graph_node import Node


async def follow_time(node: Node) -> Clock:
    """Set a node's clock: simulated time from /clock if /use_sim_time is true, else wall time.

    The parameter is read once, as in rospy and roscpp.
    """
    if await node.params.get("/use_sim_time", False):
        clock = SimClock(node.loop)
        node.subscribe(
            "/clock", "rosgraph_msgs/Clock", lambda m: clock.set(to_nsec(m.clock)), queue_size=1, on_loop=True
        )
        node.clock = clock
    else:
        node.clock = WallClock()
    return node.clock

"""The clock that /use_sim_time asks for."""

from .clock import Clock, SimClock, WallClock, to_nsec
from .node import Node


async def follow_time(node: Node) -> Clock:
    """Give a node the graph's clock: simulated time from /clock where /use_sim_time is true, else the wall's.

    The parameter is read once, as the original libraries do.
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

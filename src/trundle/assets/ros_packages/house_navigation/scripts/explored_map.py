#!/usr/bin/env python3
"""Publishes the map on `explored_map` when explore_lite has no frontier left."""

import rospy
from nav_msgs.msg import OccupancyGrid
from rosgraph_msgs.msg import Log


def main():
    """Wait for the end of the exploration; the map stays published."""
    rospy.init_node("explored_map")
    explored = rospy.Publisher("explored_map", OccupancyGrid, queue_size=1, latch=True)

    def read_log(message):
        if message.name == rospy.resolve_name("explore") and message.msg.startswith("Exploration stopped"):
            grid = rospy.wait_for_message("map", OccupancyGrid)
            floor = sum(cell == 0 for cell in grid.data) * grid.info.resolution**2
            print(f"explored {floor:.1f} m² of floor in {rospy.get_time():.0f} s", flush=True)
            explored.publish(grid)

    rospy.Subscriber("/rosout_agg", Log, read_log)
    rospy.spin()


main()

"""Well-known executables without a built-in replacement, and alternatives."""

OVER_THE_WIRE = "the real one can run in a container with ROS_MASTER_URI set to this master"
_NAVIGATION = f"Trundle has no stand-in for it; {OVER_THE_WIRE}"
_DATABASE = "scenes and constraints are not kept in a database; move_group plans without one, as with db:=false"
_DRIVER = "a driver of real hardware; the simulator's sensors publish the same topics where the model has them"
_ROSSERIAL = (
    "it talks to a microcontroller on a serial port; rosserial_python's serial_node.py is Python, and runs here: "
    "trundle pack get rosserial_python, and pip install pyserial"
)

ALTERNATIVES: dict[str, str] = {
    "cartographer_ros": _NAVIGATION,
    "costmap_2d": _NAVIGATION,
    "global_planner": _NAVIGATION,
    "karto_slam": _NAVIGATION,
    "mbf_simple_nav": "its plugins are C++ without a costmap; mbf_costmap_nav has a stand-in with the same actions",
    "moveit_ros_benchmarks": f"there are no benchmarks of planners; {OVER_THE_WIRE}",
    "moveit_ros_perception": "move_group reads depth sensors itself, by the parameters ~sensors",
    "moveit_ros_visualization": "the page has its panel and displays; rviz of a launch file opens it",
    "moveit_ros_warehouse": _DATABASE,
    "moveit_servo": _NAVIGATION,
    "warehouse_ros_mongo": _DATABASE,
    "warehouse_ros_sqlite": _DATABASE,
    "moveit_setup_assistant": "a tool that writes files; run the real one once, Trundle reads its output",
    "rtabmap_ros": _NAVIGATION,
    "robot_localization": _NAVIGATION,
    "uvc_camera": _DRIVER,
    "hokuyo_node": _DRIVER,
    "urg_node": _DRIVER,
    "rplidar_ros": _DRIVER,
    "openni_launch": _DRIVER,
    "realsense2_camera": _DRIVER,
    "hls_lfcd_lds_driver": _DRIVER,
    "rosserial_arduino": _ROSSERIAL,
    "rosserial_python": _ROSSERIAL,
    "rosserial_server": _ROSSERIAL,
    "um6": _DRIVER,
    "lms1xx": _DRIVER,
}
"""Package → alternative."""

"""Table of the commands of ROS 1, catkin and Gazebo."""

ORIGINALS: dict[str, tuple[str, ...]] = {
    "catkin_create_pkg": ("originals.catkin_create_pkg",),
    "catkin_init_workspace": ("originals.catkin_init_workspace",),
    "catkin_make": ("originals.catkin_make",),
    "check_urdf": ("originals.check_urdf",),
    "gazebo": ("originals.gazebo",),
    "gz": ("originals.gz",),
    "gzclient": ("originals.gzclient",),
    "gzserver": ("originals.gazebo",),
    "rosbag": ("bag",),
    "roscd": ("originals.roscd",),
    "rosclean": ("originals.rosclean",),
    "roscore": ("core",),
    "roslaunch": ("launch",),
    "rosls": ("originals.rosls",),
    "rosmsg": ("msg",),
    "rosnode": ("node",),
    "rospack": ("pack",),
    "rosparam": ("param",),
    "rosrun": ("exec",),
    "rosservice": ("service",),
    "rossrv": ("srv",),
    "rostest": ("test",),
    "rostopic": ("topic",),
    "rosversion": ("originals.rosversion",),
    "roswtf": ("originals.roswtf",),
    "rqt": ("exec", "rqt_gui", "rqt_gui"),
    "rqt_console": ("exec", "rqt_console", "rqt_console"),
    "rqt_graph": ("exec", "rqt_graph", "rqt_graph"),
    "rqt_image_view": ("exec", "rqt_image_view", "rqt_image_view"),
    "rqt_plot": ("exec", "rqt_plot", "rqt_plot"),
    "rviz": ("originals.rviz",),
    "tf_echo": ("tf", "echo"),
    "tf_monitor": ("tf", "monitor"),
    "urdf_to_graphiz": ("originals.urdf_to_graphiz",),
    "view_frames": ("tf", "tree", "-o", "frames.svg"),
    "xacro": ("xacro",),
}
"""Command → module in `trundle.cli` and the arguments before those given."""

FUNCTIONS = ("roscd",)
"""Commands that the shell itself runs, since they change its folder."""

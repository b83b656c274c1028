"""Which stock executables have a stand-in; a stand-in is imported only when a launch asks for it."""

STAND_INS: dict[tuple[str, str], str] = {
    ("arbotix_python", "arbotix_driver"): "trundle.nodes.arbotix:ArbotixDriver",
    ("arbotix_python", "arbotix_driver.py"): "trundle.nodes.arbotix:ArbotixDriver",
    ("arbotix_python", "driver.py"): "trundle.nodes.arbotix:ArbotixDriver",
    ("gazebo_ros", "debug"): "trundle.nodes.gazebo:GazeboServer",
    ("gazebo_ros", "gazebo"): "trundle.nodes.gazebo:GazeboServer",
    ("gazebo_ros", "gdbrun"): "trundle.nodes.gazebo:GazeboServer",
    ("gazebo_ros", "gzclient"): "trundle.nodes.gazebo:GazeboClient",
    ("gazebo_ros", "gzserver"): "trundle.nodes.gazebo:GazeboServer",
    ("gazebo_ros", "perf"): "trundle.nodes.gazebo:GazeboServer",
    ("gazebo_ros", "spawn_model"): "trundle.nodes.gazebo:SpawnModel",
    ("gazebo_ros", "urdf_spawner"): "trundle.nodes.gazebo:SpawnModel",
    ("joint_state_publisher", "joint_state_publisher"): "trundle.nodes.joint_state_publisher:JointStatePublisher",
    ("joint_state_publisher_gui", "joint_state_publisher_gui"): (
        "trundle.nodes.joint_state_publisher:JointStatePublisherGui"
    ),
    ("robot_state_publisher", "robot_state_publisher"): "trundle.nodes.robot_state_publisher:RobotStatePublisher",
    ("robot_state_publisher", "state_publisher"): "trundle.nodes.robot_state_publisher:StatePublisher",
    ("map_server", "map_saver"): "trundle.nodes.map_server:MapSaver",
    ("map_server", "map_server"): "trundle.nodes.map_server:MapServer",
    ("rviz", "rviz"): "trundle.nodes.rviz:Rviz",
    ("teleop_twist_keyboard", "teleop_twist_keyboard.py"): "trundle.nodes.teleop_twist_keyboard:TeleopTwistKeyboard",
    ("tf", "static_transform_publisher"): "trundle.nodes.static_transform_publisher:TfStaticTransformPublisher",
    ("tf2_ros", "static_transform_publisher"): "trundle.nodes.static_transform_publisher:Tf2StaticTransformPublisher",
    ("topic_tools", "drop"): "trundle.nodes.topic_tools:Drop",
    ("topic_tools", "mux"): "trundle.nodes.topic_tools:Mux",
    ("topic_tools", "relay"): "trundle.nodes.topic_tools:Relay",
    ("topic_tools", "throttle"): "trundle.nodes.topic_tools:Throttle",
    ("topic_tools", "transform"): "trundle.nodes.topic_tools:Transform",
    ("turtlesim", "draw_square"): "trundle.nodes.turtlesim:DrawSquare",
    ("turtlesim", "mimic"): "trundle.nodes.turtlesim:Mimic",
    ("turtlesim", "turtle_teleop_key"): "trundle.nodes.turtlesim:TurtleTeleopKey",
    ("turtlesim", "turtlesim_node"): "trundle.nodes.turtlesim:TurtleSim",
}
"""(package, type) → "module:Class"."""

OURS_ALWAYS = frozenset({"gazebo_ros"})
"""Packages whose programs would start another simulator: ours stands in even where the original is installed."""

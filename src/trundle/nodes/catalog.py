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
    ("rviz", "rviz"): "trundle.nodes.rviz:Rviz",
    ("tf", "static_transform_publisher"): "trundle.nodes.static_transform_publisher:TfStaticTransformPublisher",
    ("tf2_ros", "static_transform_publisher"): "trundle.nodes.static_transform_publisher:Tf2StaticTransformPublisher",
}
"""(package, type) → "module:Class"."""

OURS_ALWAYS = frozenset({"gazebo_ros"})
"""Packages whose programs would start another simulator: ours stands in even where the original is installed."""

"""Catalogue of built-in replacements for stock executables; each is imported only on use."""

BUILTIN_NODES: dict[tuple[str, str], str] = {
    ("arbotix_controllers", "gripper_controller"): "trundle.nodes.arbotix:GripperController",
    ("arbotix_controllers", "gripper_controller.py"): "trundle.nodes.arbotix:GripperController",
    ("arbotix_python", "arbotix_driver"): "trundle.nodes.arbotix:ArbotixDriver",
    ("arbotix_python", "arbotix_driver.py"): "trundle.nodes.arbotix:ArbotixDriver",
    ("arbotix_python", "arbotix_gui"): "trundle.nodes.rqt_windows:Window",
    ("arbotix_python", "driver.py"): "trundle.nodes.arbotix:ArbotixDriver",
    ("controller_manager", "controller_manager"): "trundle.nodes.controller_manager:ControllerManagerTool",
    ("controller_manager", "spawner"): "trundle.nodes.controller_manager:Spawner",
    ("controller_manager", "spawner.py"): "trundle.nodes.controller_manager:Spawner",
    ("controller_manager", "unspawner"): "trundle.nodes.controller_manager:Unspawner",
    ("cv_camera", "cv_camera_node"): "trundle.nodes.camera_drivers:CvCamera",
    (
        "depthimage_to_laserscan",
        "depthimage_to_laserscan",
    ): "trundle.nodes.depthimage_to_laserscan:DepthImageToLaserScan",
    ("dynamic_reconfigure", "dynparam"): "trundle.nodes.dynparam:Dynparam",
    ("dynamic_reconfigure", "reconfigure_gui"): "trundle.nodes.rqt_windows:RqtReconfigure",
    ("gazebo_ros", "debug"): "trundle.nodes.gazebo:GazeboServer",
    ("gazebo_ros", "gazebo"): "trundle.nodes.gazebo:Gazebo",
    ("gazebo_ros", "gdbrun"): "trundle.nodes.gazebo:GazeboServer",
    ("gazebo_ros", "gzclient"): "trundle.nodes.gazebo:GazeboClient",
    ("gazebo_ros", "gzserver"): "trundle.nodes.gazebo:GazeboServer",
    ("gazebo_ros", "perf"): "trundle.nodes.gazebo:GazeboServer",
    ("gazebo_ros", "spawn_model"): "trundle.nodes.gazebo:SpawnModel",
    ("gazebo_ros", "urdf_spawner"): "trundle.nodes.gazebo:SpawnModel",
    ("gscam", "gscam"): "trundle.nodes.camera_drivers:GsCam",
    ("gscam", "gscam_node"): "trundle.nodes.camera_drivers:GsCam",
    ("image_view", "image_view"): "trundle.nodes.rqt_windows:ImageView",
    ("interactive_marker_twist_server", "marker_server"): "trundle.nodes.twist_marker_server:TwistMarkerServer",
    ("joint_state_publisher", "joint_state_publisher"): "trundle.nodes.joint_state_publisher:JointStatePublisher",
    (
        "joint_state_publisher_gui",
        "joint_state_publisher_gui",
    ): "trundle.nodes.joint_state_publisher:JointStatePublisherGui",
    ("joy", "joy_node"): "trundle.nodes.joy_node:JoyNode",
    ("map_server", "map_saver"): "trundle.nodes.map_server:MapSaver",
    ("map_server", "map_server"): "trundle.nodes.map_server:MapServer",
    ("nodelet", "nodelet"): "trundle.nodes.nodelet:Nodelet",
    (
        "pointcloud_to_laserscan",
        "pointcloud_to_laserscan_node",
    ): "trundle.nodes.pointcloud_to_laserscan:PointCloudToLaserScan",
    ("robot_localization", "ekf_localization_node"): "trundle.nodes.robot_localization:EkfLocalization",
    ("robot_localization", "ukf_localization_node"): "trundle.nodes.robot_localization:EkfLocalization",
    ("robot_pose_publisher", "robot_pose_publisher"): "trundle.nodes.robot_pose_publisher:RobotPosePublisher",
    ("robot_state_publisher", "robot_state_publisher"): "trundle.nodes.robot_state_publisher:RobotStatePublisher",
    ("robot_state_publisher", "state_publisher"): "trundle.nodes.robot_state_publisher:StatePublisher",
    ("rosapi", "rosapi_node"): "trundle.nodes.rosapi:Rosapi",
    ("rosbag", "play"): "trundle.nodes.command_line_tools:RosbagPlay",
    ("rosbag", "record"): "trundle.nodes.command_line_tools:RosbagRecord",
    ("rosbridge_server", "rosbridge_tcp"): "trundle.nodes.rosbridge:RosbridgeTcp",
    ("rosbridge_server", "rosbridge_tcp.py"): "trundle.nodes.rosbridge:RosbridgeTcp",
    ("rosbridge_server", "rosbridge_websocket"): "trundle.nodes.rosbridge:RosbridgeWebsocket",
    ("rosbridge_server", "rosbridge_websocket.py"): "trundle.nodes.rosbridge:RosbridgeWebsocket",
    ("roscpp_tutorials", "add_two_ints_client"): "trundle.nodes.tutorials:CppAddTwoIntsClient",
    ("roscpp_tutorials", "add_two_ints_server"): "trundle.nodes.tutorials:CppAddTwoIntsServer",
    ("roscpp_tutorials", "listener"): "trundle.nodes.tutorials:CppListener",
    ("roscpp_tutorials", "talker"): "trundle.nodes.tutorials:CppTalker",
    ("rosparam", "rosparam"): "trundle.nodes.command_line_tools:Rosparam",
    ("rospy_tutorials", "add_two_ints_client"): "trundle.nodes.tutorials:AddTwoIntsClient",
    ("rospy_tutorials", "add_two_ints_client.py"): "trundle.nodes.tutorials:AddTwoIntsClient",
    ("rospy_tutorials", "add_two_ints_server"): "trundle.nodes.tutorials:AddTwoIntsServer",
    ("rospy_tutorials", "add_two_ints_server.py"): "trundle.nodes.tutorials:AddTwoIntsServer",
    ("rospy_tutorials", "listener"): "trundle.nodes.tutorials:Listener",
    ("rospy_tutorials", "listener.py"): "trundle.nodes.tutorials:Listener",
    ("rospy_tutorials", "talker"): "trundle.nodes.tutorials:Talker",
    ("rospy_tutorials", "talker.py"): "trundle.nodes.tutorials:Talker",
    ("rosservice", "rosservice"): "trundle.nodes.command_line_tools:Rosservice",
    ("rostopic", "rostopic"): "trundle.nodes.command_line_tools:Rostopic",
    ("rqt_bag", "rqt_bag"): "trundle.nodes.rqt_windows:RqtBag",
    ("rqt_console", "rqt_console"): "trundle.nodes.rqt_windows:RqtConsole",
    ("rqt_graph", "rqt_graph"): "trundle.nodes.rqt_windows:RqtGraph",
    ("rqt_gui", "rqt_gui"): "trundle.nodes.rqt_windows:Window",
    ("rqt_image_view", "rqt_image_view"): "trundle.nodes.rqt_windows:RqtImageView",
    ("rqt_joint_trajectory_controller", "rqt_joint_trajectory_controller"): "trundle.nodes.rqt_windows:Window",
    ("rqt_plot", "rqt_plot"): "trundle.nodes.rqt_windows:RqtPlot",
    ("rqt_publisher", "rqt_publisher"): "trundle.nodes.rqt_windows:RqtPublisher",
    ("rqt_reconfigure", "rqt_reconfigure"): "trundle.nodes.rqt_windows:RqtReconfigure",
    ("rqt_robot_monitor", "rqt_robot_monitor"): "trundle.nodes.rqt_windows:RqtRobotMonitor",
    ("rqt_robot_steering", "rqt_robot_steering"): "trundle.nodes.rqt_windows:RqtRobotSteering",
    ("rqt_service_caller", "rqt_service_caller"): "trundle.nodes.rqt_windows:RqtServiceCaller",
    ("rqt_tf_tree", "rqt_tf_tree"): "trundle.nodes.rqt_windows:RqtTfTree",
    ("rqt_topic", "rqt_topic"): "trundle.nodes.rqt_windows:RqtTopic",
    ("rviz", "rviz"): "trundle.nodes.rviz:Rviz",
    ("sound_play", "soundplay_node.py"): "trundle.nodes.sound_play:SoundPlay",
    ("teleop_twist_joy", "teleop_node"): "trundle.nodes.teleop_twist_joy:TeleopTwistJoy",
    ("teleop_twist_keyboard", "teleop_twist_keyboard.py"): "trundle.nodes.teleop_twist_keyboard:TeleopTwistKeyboard",
    ("tf", "static_transform_publisher"): "trundle.nodes.static_transform_publisher:TfStaticTransformPublisher",
    ("tf", "tf_echo"): "trundle.nodes.command_line_tools:TfEcho",
    ("tf", "tf_monitor"): "trundle.nodes.command_line_tools:TfMonitor",
    ("tf", "view_frames"): "trundle.nodes.command_line_tools:ViewFrames",
    ("tf2_ros", "buffer_server"): "trundle.nodes.buffer_server:BufferServer",
    ("tf2_ros", "static_transform_publisher"): "trundle.nodes.static_transform_publisher:Tf2StaticTransformPublisher",
    ("tf2_tools", "echo.py"): "trundle.nodes.command_line_tools:TfEcho",
    ("tf2_tools", "view_frames.py"): "trundle.nodes.command_line_tools:ViewFrames",
    ("tf2_web_republisher", "tf2_web_republisher"): "trundle.nodes.tf2_web_republisher:Tf2WebRepublisher",
    ("topic_tools", "drop"): "trundle.nodes.topic_tools:Drop",
    ("topic_tools", "mux"): "trundle.nodes.topic_tools:Mux",
    ("topic_tools", "relay"): "trundle.nodes.topic_tools:Relay",
    ("topic_tools", "throttle"): "trundle.nodes.topic_tools:Throttle",
    ("topic_tools", "transform"): "trundle.nodes.topic_tools:Transform",
    ("turtle_tf", "turtle_tf_broadcaster"): "trundle.nodes.tutorials:TurtleBroadcaster",
    ("turtle_tf", "turtle_tf_broadcaster.py"): "trundle.nodes.tutorials:TurtleBroadcaster",
    ("turtle_tf", "turtle_tf_listener"): "trundle.nodes.tutorials:TurtleFollower",
    ("turtle_tf", "turtle_tf_listener.py"): "trundle.nodes.tutorials:TurtleFollower",
    ("turtle_tf2", "turtle_tf2_broadcaster"): "trundle.nodes.tutorials:TurtleBroadcaster",
    ("turtle_tf2", "turtle_tf2_broadcaster.py"): "trundle.nodes.tutorials:TurtleBroadcaster",
    ("turtle_tf2", "turtle_tf2_listener"): "trundle.nodes.tutorials:TurtleFollower",
    ("turtle_tf2", "turtle_tf2_listener.py"): "trundle.nodes.tutorials:TurtleFollower",
    ("turtlebot3_teleop", "turtlebot3_teleop_key"): "trundle.nodes.turtlebot3_teleop_key:Turtlebot3TeleopKey",
    ("turtlebot_teleop", "turtlebot_teleop_key"): "trundle.nodes.teleop_twist_keyboard:TurtlebotTeleopKey",
    ("turtlesim", "draw_square"): "trundle.nodes.turtlesim:DrawSquare",
    ("turtlesim", "mimic"): "trundle.nodes.turtlesim:Mimic",
    ("turtlesim", "turtle_teleop_key"): "trundle.nodes.turtlesim:TurtleTeleopKey",
    ("turtlesim", "turtlesim_node"): "trundle.nodes.turtlesim:TurtleSim",
    ("twist_mux", "twist_mux"): "trundle.nodes.twist_mux:TwistMux",
    ("usb_cam", "usb_cam_node"): "trundle.nodes.camera_drivers:UsbCam",
    ("web_video_server", "web_video_server"): "trundle.nodes.web_video_server:WebVideoServer",
}
"""(package, type) → "module:Class"."""

NODELETS: dict[str, str] = {
    "cmd_vel_mux/CmdVelMuxNodelet": "trundle.nodes.cmd_vel_mux:CmdVelMux",
    "depthimage_to_laserscan/DepthImageToLaserScanNodelet": (
        "trundle.nodes.depthimage_to_laserscan:DepthImageToLaserScan"
    ),
    "pointcloud_to_laserscan/PointCloudToLaserScanNodelet": (
        "trundle.nodes.pointcloud_to_laserscan:PointCloudToLaserScan"
    ),
    "pointcloud_to_laserscan/pointcloud_to_laserscan_nodelet": (
        "trundle.nodes.pointcloud_to_laserscan:PointCloudToLaserScan"
    ),
    "yocs_cmd_vel_mux/CmdVelMuxNodelet": "trundle.nodes.cmd_vel_mux:CmdVelMux",
}
"""Nodelet class as in launch files → "module:Class"."""

WORLDS = frozenset(("gazebo_ros", type_) for type_ in ("gzserver", "gazebo", "debug", "gdbrun", "perf"))
"""Nodes that simulate a world, and so publish /clock."""

WINDOWS = frozenset(
    key
    for key in BUILTIN_NODES
    if key[0] in ("image_view", "joint_state_publisher_gui", "joy", "rviz") or key[0].startswith("rqt_")
) | {
    ("turtlesim", "turtlesim_node"),
    ("dynamic_reconfigure", "reconfigure_gui"),
    ("arbotix_python", "arbotix_gui"),
}
"""Nodes with a window: each opens the page."""

KEYBOARDS = frozenset(
    key for key in BUILTIN_NODES if key[1] == "teleop_twist_keyboard.py" or key[1].endswith("_teleop_key")
)
"""Nodes that read keys."""

CLIENTS = frozenset({("gazebo_ros", "gzclient"), ("gazebo_ros", "gazebo")})
"""Nodes that open the page of the simulated world."""

OURS_ALWAYS = frozenset({"gazebo_ros"})
"""Packages that are replaced even if installed, since their programs would start another simulator."""

_IN_PYTHON = (
    "arbotix_",
    "controller_manager",
    "dynamic_reconfigure",
    "joint_state_publisher",
    "rosapi",
    "rosbridge_",
    "rospy_tutorials",
    "rosparam",
    "rosservice",
    "rostopic",
    "rqt_",
    "teleop_twist_keyboard",
    "tf2_tools",
    "turtle_tf",
    "turtlebot",
)
ROSCPP = frozenset(
    key for key in BUILTIN_NODES if not key[0].startswith(_IN_PYTHON) and key[1] not in ("spawn_model", "urdf_spawner")
)
"""Nodes whose originals use roscpp, which names loggers differently."""

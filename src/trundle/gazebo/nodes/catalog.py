"""Catalog of built-in replacements for stock executables, imported on use."""

BUILTIN_NODES: dict[tuple[str, str], str] = {
    ("amcl", "amcl"): "trundle.navigation.localization:Amcl",
    ("arbotix_controllers", "gripper_controller"): "trundle.gazebo.nodes.arbotix:GripperController",
    ("arbotix_controllers", "gripper_controller.py"): "trundle.gazebo.nodes.arbotix:GripperController",
    ("arbotix_python", "arbotix_driver"): "trundle.gazebo.nodes.arbotix:ArbotixDriver",
    ("arbotix_python", "arbotix_driver.py"): "trundle.gazebo.nodes.arbotix:ArbotixDriver",
    ("arbotix_python", "arbotix_gui"): "trundle.gazebo.nodes.rqt_windows:Window",
    ("arbotix_python", "driver.py"): "trundle.gazebo.nodes.arbotix:ArbotixDriver",
    ("cartographer_ros", "cartographer_node"): "trundle.navigation.mapping:CartographerNode",
    (
        "cartographer_ros",
        "cartographer_occupancy_grid_node",
    ): "trundle.navigation.mapping:CartographerOccupancyGridNode",
    ("controller_manager", "controller_manager"): "trundle.gazebo.nodes.controller_manager:ControllerManagerTool",
    ("controller_manager", "spawner"): "trundle.gazebo.nodes.controller_manager:Spawner",
    ("controller_manager", "spawner.py"): "trundle.gazebo.nodes.controller_manager:Spawner",
    ("controller_manager", "unspawner"): "trundle.gazebo.nodes.controller_manager:Unspawner",
    ("cv_camera", "cv_camera_node"): "trundle.gazebo.nodes.camera_drivers:CvCamera",
    (
        "depthimage_to_laserscan",
        "depthimage_to_laserscan",
    ): "trundle.gazebo.nodes.depthimage_to_laserscan:DepthImageToLaserScan",
    ("dynamic_reconfigure", "dynparam"): "trundle.gazebo.nodes.dynparam:Dynparam",
    ("dynamic_reconfigure", "reconfigure_gui"): "trundle.gazebo.nodes.rqt_windows:RqtReconfigure",
    ("explore_lite", "explore"): "trundle.navigation.exploration:Explore",
    ("fake_localization", "fake_localization"): "trundle.navigation.localization:FakeLocalization",
    ("follow_waypoints", "follow_waypoints"): "trundle.navigation.waypoints:FollowWaypoints",
    ("follow_waypoints", "follow_waypoints_node.py"): "trundle.navigation.waypoints:FollowWaypoints",
    ("frontier_exploration", "explore_client"): "trundle.navigation.exploration:ExploreClient",
    ("frontier_exploration", "explore_server"): "trundle.navigation.exploration:ExploreServer",
    ("gazebo_ros", "debug"): "trundle.gazebo.nodes.gazebo:GazeboServer",
    ("gazebo_ros", "gazebo"): "trundle.gazebo.nodes.gazebo:Gazebo",
    ("gazebo_ros", "gdbrun"): "trundle.gazebo.nodes.gazebo:GazeboServer",
    ("gazebo_ros", "gzclient"): "trundle.gazebo.nodes.gazebo:GazeboClient",
    ("gazebo_ros", "gzserver"): "trundle.gazebo.nodes.gazebo:GazeboServer",
    ("gazebo_ros", "perf"): "trundle.gazebo.nodes.gazebo:GazeboServer",
    ("gazebo_ros", "spawn_model"): "trundle.gazebo.nodes.gazebo:SpawnModel",
    ("gazebo_ros", "urdf_spawner"): "trundle.gazebo.nodes.gazebo:SpawnModel",
    ("gmapping", "slam_gmapping"): "trundle.navigation.mapping:SlamGmapping",
    ("gscam", "gscam"): "trundle.gazebo.nodes.camera_drivers:GsCam",
    ("gscam", "gscam_node"): "trundle.gazebo.nodes.camera_drivers:GsCam",
    ("hector_mapping", "hector_mapping"): "trundle.navigation.mapping:HectorMapping",
    ("image_view", "image_view"): "trundle.gazebo.nodes.rqt_windows:ImageView",
    (
        "imu_complementary_filter",
        "complementary_filter_node",
    ): "trundle.gazebo.nodes.imu_filters:ImuComplementaryFilter",
    ("imu_filter_madgwick", "imu_filter_node"): "trundle.gazebo.nodes.imu_filters:ImuFilterMadgwick",
    ("interactive_marker_twist_server", "marker_server"): "trundle.gazebo.nodes.twist_marker_server:TwistMarkerServer",
    ("ira_laser_tools", "laserscan_multi_merger"): "trundle.navigation.scan_filters:LaserscanMultiMerger",
    (
        "joint_state_publisher",
        "joint_state_publisher",
    ): "trundle.gazebo.nodes.joint_state_publisher:JointStatePublisher",
    (
        "joint_state_publisher_gui",
        "joint_state_publisher_gui",
    ): "trundle.gazebo.nodes.joint_state_publisher:JointStatePublisherGui",
    ("joy", "joy_node"): "trundle.gazebo.nodes.joy_node:JoyNode",
    ("laser_filters", "scan_to_cloud_filter_chain"): "trundle.navigation.scan_filters:ScanToCloudFilterChain",
    ("laser_filters", "scan_to_scan_filter_chain"): "trundle.navigation.scan_filters:ScanToScanFilterChain",
    ("laser_scan_matcher", "laser_scan_matcher_node"): "trundle.navigation.scan_odometry:LaserScanMatcher",
    ("map_server", "map_saver"): "trundle.gazebo.nodes.map_server:MapSaver",
    ("map_server", "map_server"): "trundle.gazebo.nodes.map_server:MapServer",
    ("mbf_costmap_nav", "mbf_costmap_nav"): "trundle.navigation.move_base_flex:MbfCostmapNav",
    ("mbf_costmap_nav", "move_base_legacy_relay.py"): "trundle.navigation.move_base_flex:LegacyRelay",
    ("move_base", "move_base"): "trundle.navigation.move_base:MoveBase",
    ("moveit_ros_move_group", "move_group"): "trundle.planning.move_group:MoveGroup",
    ("nodelet", "nodelet"): "trundle.gazebo.nodes.nodelet:Nodelet",
    ("octomap_server", "octomap_saver"): "trundle.navigation.octomaps:OctomapSaver",
    ("octomap_server", "octomap_server_node"): "trundle.navigation.octomaps:OctomapServer",
    ("octomap_server", "octomap_server_static"): "trundle.navigation.octomaps:OctomapServerStatic",
    (
        "pointcloud_to_laserscan",
        "pointcloud_to_laserscan_node",
    ): "trundle.gazebo.nodes.pointcloud_to_laserscan:PointCloudToLaserScan",
    ("rf2o_laser_odometry", "rf2o_laser_odometry_node"): "trundle.navigation.scan_odometry:Rf2oLaserOdometry",
    ("robot_localization", "ekf_localization_node"): "trundle.gazebo.nodes.robot_localization:EkfLocalization",
    ("robot_localization", "navsat_transform_node"): "trundle.gazebo.nodes.robot_localization:NavsatTransform",
    ("robot_localization", "ukf_localization_node"): "trundle.gazebo.nodes.robot_localization:UkfLocalization",
    ("robot_pose_ekf", "robot_pose_ekf"): "trundle.gazebo.nodes.robot_pose_ekf:RobotPoseEkf",
    ("robot_pose_publisher", "robot_pose_publisher"): "trundle.gazebo.nodes.robot_pose_publisher:RobotPosePublisher",
    (
        "robot_state_publisher",
        "robot_state_publisher",
    ): "trundle.gazebo.nodes.robot_state_publisher:RobotStatePublisher",
    ("robot_state_publisher", "state_publisher"): "trundle.gazebo.nodes.robot_state_publisher:StatePublisher",
    ("rosapi", "rosapi_node"): "trundle.gazebo.nodes.rosapi:Rosapi",
    ("rosbag", "play"): "trundle.gazebo.nodes.command_line_tools:RosbagPlay",
    ("rosbag", "record"): "trundle.gazebo.nodes.command_line_tools:RosbagRecord",
    ("rosbridge_server", "rosbridge_tcp"): "trundle.gazebo.nodes.rosbridge:RosbridgeTcp",
    ("rosbridge_server", "rosbridge_tcp.py"): "trundle.gazebo.nodes.rosbridge:RosbridgeTcp",
    ("rosbridge_server", "rosbridge_websocket"): "trundle.gazebo.nodes.rosbridge:RosbridgeWebsocket",
    ("rosbridge_server", "rosbridge_websocket.py"): "trundle.gazebo.nodes.rosbridge:RosbridgeWebsocket",
    ("roscpp_tutorials", "add_two_ints_client"): "trundle.gazebo.nodes.tutorials:CppAddTwoIntsClient",
    ("roscpp_tutorials", "add_two_ints_server"): "trundle.gazebo.nodes.tutorials:CppAddTwoIntsServer",
    ("roscpp_tutorials", "listener"): "trundle.gazebo.nodes.tutorials:CppListener",
    ("roscpp_tutorials", "talker"): "trundle.gazebo.nodes.tutorials:CppTalker",
    ("rosparam", "rosparam"): "trundle.gazebo.nodes.command_line_tools:Rosparam",
    ("rospy_tutorials", "add_two_ints_client"): "trundle.gazebo.nodes.tutorials:AddTwoIntsClient",
    ("rospy_tutorials", "add_two_ints_client.py"): "trundle.gazebo.nodes.tutorials:AddTwoIntsClient",
    ("rospy_tutorials", "add_two_ints_server"): "trundle.gazebo.nodes.tutorials:AddTwoIntsServer",
    ("rospy_tutorials", "add_two_ints_server.py"): "trundle.gazebo.nodes.tutorials:AddTwoIntsServer",
    ("rospy_tutorials", "listener"): "trundle.gazebo.nodes.tutorials:Listener",
    ("rospy_tutorials", "listener.py"): "trundle.gazebo.nodes.tutorials:Listener",
    ("rospy_tutorials", "talker"): "trundle.gazebo.nodes.tutorials:Talker",
    ("rospy_tutorials", "talker.py"): "trundle.gazebo.nodes.tutorials:Talker",
    ("rosservice", "rosservice"): "trundle.gazebo.nodes.command_line_tools:Rosservice",
    ("rostopic", "rostopic"): "trundle.gazebo.nodes.command_line_tools:Rostopic",
    ("rqt_bag", "rqt_bag"): "trundle.gazebo.nodes.rqt_windows:RqtBag",
    ("rqt_console", "rqt_console"): "trundle.gazebo.nodes.rqt_windows:RqtConsole",
    ("rqt_graph", "rqt_graph"): "trundle.gazebo.nodes.rqt_windows:RqtGraph",
    ("rqt_gui", "rqt_gui"): "trundle.gazebo.nodes.rqt_windows:Window",
    ("rqt_image_view", "rqt_image_view"): "trundle.gazebo.nodes.rqt_windows:RqtImageView",
    ("rqt_joint_trajectory_controller", "rqt_joint_trajectory_controller"): "trundle.gazebo.nodes.rqt_windows:Window",
    ("rqt_plot", "rqt_plot"): "trundle.gazebo.nodes.rqt_windows:RqtPlot",
    ("rqt_publisher", "rqt_publisher"): "trundle.gazebo.nodes.rqt_windows:RqtPublisher",
    ("rqt_reconfigure", "rqt_reconfigure"): "trundle.gazebo.nodes.rqt_windows:RqtReconfigure",
    ("rqt_robot_monitor", "rqt_robot_monitor"): "trundle.gazebo.nodes.rqt_windows:RqtRobotMonitor",
    ("rqt_robot_steering", "rqt_robot_steering"): "trundle.gazebo.nodes.rqt_windows:RqtRobotSteering",
    ("rqt_service_caller", "rqt_service_caller"): "trundle.gazebo.nodes.rqt_windows:RqtServiceCaller",
    ("rqt_tf_tree", "rqt_tf_tree"): "trundle.gazebo.nodes.rqt_windows:RqtTfTree",
    ("rqt_topic", "rqt_topic"): "trundle.gazebo.nodes.rqt_windows:RqtTopic",
    ("rrt_exploration", "assigner.py"): "trundle.navigation.exploration:RrtAssigner",
    ("rrt_exploration", "filter.py"): "trundle.navigation.exploration:RrtFilter",
    ("rrt_exploration", "frontier_opencv_detector.py"): "trundle.navigation.exploration:FrontierDetector",
    ("rrt_exploration", "global_rrt_detector"): "trundle.navigation.exploration:GlobalRrtDetector",
    ("rrt_exploration", "local_rrt_detector"): "trundle.navigation.exploration:LocalRrtDetector",
    ("rviz", "rviz"): "trundle.gazebo.nodes.rviz:Rviz",
    ("slam_karto", "slam_karto"): "trundle.navigation.mapping:SlamKarto",
    ("slam_toolbox", "async_slam_toolbox_node"): "trundle.navigation.mapping:AsyncSlamToolbox",
    ("slam_toolbox", "localization_slam_toolbox_node"): "trundle.navigation.mapping:LocalizationSlamToolbox",
    ("slam_toolbox", "sync_slam_toolbox_node"): "trundle.navigation.mapping:SyncSlamToolbox",
    ("sound_play", "soundplay_node.py"): "trundle.gazebo.nodes.sound_play:SoundPlay",
    ("teleop_twist_joy", "teleop_node"): "trundle.gazebo.nodes.teleop_twist_joy:TeleopTwistJoy",
    (
        "teleop_twist_keyboard",
        "teleop_twist_keyboard.py",
    ): "trundle.gazebo.nodes.teleop_twist_keyboard:TeleopTwistKeyboard",
    ("tf", "static_transform_publisher"): "trundle.gazebo.nodes.static_transform_publisher:TfStaticTransformPublisher",
    ("tf", "tf_echo"): "trundle.gazebo.nodes.command_line_tools:TfEcho",
    ("tf", "tf_monitor"): "trundle.gazebo.nodes.command_line_tools:TfMonitor",
    ("tf", "view_frames"): "trundle.gazebo.nodes.command_line_tools:ViewFrames",
    ("tf2_ros", "buffer_server"): "trundle.gazebo.nodes.buffer_server:BufferServer",
    (
        "tf2_ros",
        "static_transform_publisher",
    ): "trundle.gazebo.nodes.static_transform_publisher:Tf2StaticTransformPublisher",
    ("tf2_tools", "echo.py"): "trundle.gazebo.nodes.command_line_tools:TfEcho",
    ("tf2_tools", "view_frames.py"): "trundle.gazebo.nodes.command_line_tools:ViewFrames",
    ("tf2_web_republisher", "tf2_web_republisher"): "trundle.gazebo.nodes.tf2_web_republisher:Tf2WebRepublisher",
    ("topic_tools", "drop"): "trundle.gazebo.nodes.topic_tools:Drop",
    ("topic_tools", "mux"): "trundle.gazebo.nodes.topic_tools:Mux",
    ("topic_tools", "relay"): "trundle.gazebo.nodes.topic_tools:Relay",
    ("topic_tools", "throttle"): "trundle.gazebo.nodes.topic_tools:Throttle",
    ("topic_tools", "transform"): "trundle.gazebo.nodes.topic_tools:Transform",
    ("turtle_tf", "turtle_tf_broadcaster"): "trundle.gazebo.nodes.tutorials:TurtleBroadcaster",
    ("turtle_tf", "turtle_tf_broadcaster.py"): "trundle.gazebo.nodes.tutorials:TurtleBroadcaster",
    ("turtle_tf", "turtle_tf_listener"): "trundle.gazebo.nodes.tutorials:TurtleFollower",
    ("turtle_tf", "turtle_tf_listener.py"): "trundle.gazebo.nodes.tutorials:TurtleFollower",
    ("turtle_tf2", "turtle_tf2_broadcaster"): "trundle.gazebo.nodes.tutorials:TurtleBroadcaster",
    ("turtle_tf2", "turtle_tf2_broadcaster.py"): "trundle.gazebo.nodes.tutorials:TurtleBroadcaster",
    ("turtle_tf2", "turtle_tf2_listener"): "trundle.gazebo.nodes.tutorials:TurtleFollower",
    ("turtle_tf2", "turtle_tf2_listener.py"): "trundle.gazebo.nodes.tutorials:TurtleFollower",
    ("turtlebot3_teleop", "turtlebot3_teleop_key"): "trundle.gazebo.nodes.turtlebot3_teleop_key:Turtlebot3TeleopKey",
    ("turtlebot_teleop", "turtlebot_teleop_key"): "trundle.gazebo.nodes.teleop_twist_keyboard:TurtlebotTeleopKey",
    ("turtlesim", "draw_square"): "trundle.gazebo.nodes.turtlesim:DrawSquare",
    ("turtlesim", "mimic"): "trundle.gazebo.nodes.turtlesim:Mimic",
    ("turtlesim", "turtle_teleop_key"): "trundle.gazebo.nodes.turtlesim:TurtleTeleopKey",
    ("turtlesim", "turtlesim_node"): "trundle.gazebo.nodes.turtlesim:TurtleSim",
    ("twist_mux", "twist_mux"): "trundle.gazebo.nodes.twist_mux:TwistMux",
    ("usb_cam", "usb_cam_node"): "trundle.gazebo.nodes.camera_drivers:UsbCam",
    ("web_video_server", "web_video_server"): "trundle.gazebo.nodes.web_video_server:WebVideoServer",
    ("yocs_waypoint_provider", "waypoint_provider"): "trundle.navigation.waypoints:WaypointProvider",
    ("yocs_waypoints_navi", "yocs_waypoints_navi_node"): "trundle.navigation.waypoints:WaypointsNavi",
}
"""(package, type) → "module:Class"."""

NODELETS: dict[str, str] = {
    "cmd_vel_mux/CmdVelMuxNodelet": "trundle.gazebo.nodes.cmd_vel_mux:CmdVelMux",
    "depthimage_to_laserscan/DepthImageToLaserScanNodelet": (
        "trundle.gazebo.nodes.depthimage_to_laserscan:DepthImageToLaserScan"
    ),
    "imu_complementary_filter/ComplementaryFilterNodelet": "trundle.gazebo.nodes.imu_filters:ImuComplementaryFilter",
    "imu_filter_madgwick/ImuFilterNodelet": "trundle.gazebo.nodes.imu_filters:ImuFilterMadgwick",
    "laser_filters/scan_to_scan_filter_chain": "trundle.navigation.scan_filters:ScanToScanFilterChain",
    "laser_scan_matcher/LaserScanMatcherNodelet": "trundle.navigation.scan_odometry:LaserScanMatcher",
    "octomap_server/OctomapServerNodelet": "trundle.navigation.octomaps:OctomapServer",
    "pointcloud_to_laserscan/PointCloudToLaserScanNodelet": (
        "trundle.gazebo.nodes.pointcloud_to_laserscan:PointCloudToLaserScan"
    ),
    "pointcloud_to_laserscan/pointcloud_to_laserscan_nodelet": (
        "trundle.gazebo.nodes.pointcloud_to_laserscan:PointCloudToLaserScan"
    ),
    "yocs_cmd_vel_mux/CmdVelMuxNodelet": "trundle.gazebo.nodes.cmd_vel_mux:CmdVelMux",
    "yocs_velocity_smoother/VelocitySmootherNodelet": "trundle.gazebo.nodes.velocity_smoother:VelocitySmoother",
}
"""Nodelet class as in launch files → "module:Class"."""

WORLDS = frozenset(("gazebo_ros", type_) for type_ in ("gzserver", "gazebo", "debug", "gdbrun", "perf"))
"""Nodes that simulate a world and publish /clock."""

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

ALWAYS_REPLACED = frozenset({"gazebo_ros", "sound_play"})
"""Packages whose stand-ins always run: the original programs start another simulator, or need GStreamer."""

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
    key
    for key in BUILTIN_NODES
    if not key[0].startswith(_IN_PYTHON)
    and not key[1].endswith(".py")
    and key[1] not in ("spawn_model", "urdf_spawner")
)
"""Nodes whose originals use roscpp, which names loggers differently."""

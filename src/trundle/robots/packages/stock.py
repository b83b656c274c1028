"""Stock ROS packages whose programs, plugins or controllers are built in.

Launch files `$(find)` them for a default, a command or a file. A package that is not installed resolves to a folder
that does not exist, so that only files in use are missing. Some sensor description packages have stand-ins with the
same macros, which create the same links and sensors from boxes and cylinders.
"""

import os

from trundle.assets import ASSETS

_TOOLS = (
    "gazebo_ros_pkgs rosbag roscpp roslaunch roslib rosmaster rosmsg rosnode rosout rosparam rospy rosservice rostopic"
)
_NODES = """
    arbotix_controllers arbotix_python controller_manager dynamic_reconfigure joint_state_publisher
    joint_state_publisher_gui map_server nodelet robot_state_publisher rosapi rosbridge_server rqt_bag rqt_console
    rqt_graph rqt_gui rqt_image_view rqt_joint_trajectory_controller rqt_plot rqt_publisher rqt_reconfigure
    rqt_robot_monitor rqt_robot_steering rqt_service_caller rqt_tf_tree rqt_topic rviz tf tf2_ros tf2_tools
    tf2_web_republisher topic_tools turtlesim twist_mux
"""
_NODES_WITH_FILES = """
    amcl cartographer_ros cv_camera depthimage_to_laserscan explore_lite fake_localization follow_waypoints
    frontier_exploration gmapping gscam hector_mapping image_view imu_complementary_filter imu_filter_madgwick
    ira_laser_tools joy laser_filters laser_scan_matcher mbf_costmap_nav move_base moveit_ros_move_group
    octomap_server pointcloud_to_laserscan rf2o_laser_odometry robot_localization robot_pose_ekf robot_pose_publisher
    rrt_exploration slam_karto slam_toolbox sound_play teleop_twist_joy teleop_twist_keyboard turtlebot3_teleop
    turtlebot_teleop usb_cam web_video_server yocs_waypoint_provider yocs_waypoints_navi
"""
_PLUGINS = """
    gazebo_grasp_plugin gazebo_plugins gazebo_ros_control gazebo_ros_link_attacher hector_gazebo_plugins
    hector_gazebo_thermal_camera hector_quadrotor_gazebo_plugins roboticsgroup_gazebo_plugins
    roboticsgroup_upatras_gazebo_plugins rotors_gazebo_plugins velodyne_gazebo_plugins xacro
"""
_CONTROLLERS = """
    ackermann_steering_controller diff_drive_controller effort_controllers force_torque_sensor_controller
    four_wheel_steering_controller gripper_action_controller imu_sensor_controller joint_state_controller
    joint_trajectory_controller mecanum_drive_controller position_controllers velocity_controllers
"""
_DESCRIPTIONS = ASSETS / "descriptions"
STOCK_WITH_FILES = frozenset(_NODES_WITH_FILES.split())
"""Packages whose launch files, parameters or modules are used by others; they are fetched when a user names them."""
STOCK = STOCK_WITH_FILES.union(f"{_TOOLS} {_NODES} {_PLUGINS} {_CONTROLLERS}".split())
DESCRIPTIONS = {name: _DESCRIPTIONS / name for name in sorted(os.listdir(_DESCRIPTIONS))}
"""Stand-ins for sensor description packages: name → folder."""

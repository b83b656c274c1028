"""Repositories of well-known packages, for messages about missing ones."""

_REPOSITORIES = {
    "ROBOTIS-GIT/open_manipulator": "open_manipulator_controller open_manipulator_description",
    "ROBOTIS-GIT/turtlebot3": """turtlebot3 turtlebot3_bringup turtlebot3_description turtlebot3_example
        turtlebot3_navigation turtlebot3_slam turtlebot3_teleop""",
    "ROBOTIS-GIT/turtlebot3_simulations": "turtlebot3_fake turtlebot3_gazebo turtlebot3_simulations",
    "PR2/pr2_common": "pr2_common pr2_description pr2_machine pr2_msgs",
    "RethinkRobotics/baxter_common": "baxter_common baxter_description baxter_core_msgs rethink_ee_description",
    "RethinkRobotics/baxter_simulator": "baxter_gazebo baxter_sim_hardware baxter_sim_kinematics baxter_simulator",
    "IntelRealSense/realsense-ros": "realsense2_camera realsense2_description",
    "cra-ros-pkg/robot_localization": "robot_localization",
    "ethz-asl/rotors_simulator": """rotors_comm rotors_control rotors_description rotors_evaluation rotors_gazebo
        rotors_joy_interface rotors_simulator rqt_rotors""",
    "frankaemika/franka_ros": """franka_control franka_description franka_example_controllers franka_gazebo
        franka_gripper franka_hw franka_msgs franka_ros franka_visualization""",
    "husky/husky": """husky_base husky_bringup husky_control husky_description husky_desktop husky_gazebo husky_msgs
        husky_navigation husky_simulator husky_viz""",
    "jackal/jackal": "jackal_control jackal_description jackal_msgs jackal_navigation jackal_tutorials",
    "jackal/jackal_simulator": "jackal_gazebo jackal_simulator",
    "ros-drivers/rgbd_launch": "rgbd_launch",
    "ros-drivers/rosserial": "rosserial rosserial_arduino rosserial_client rosserial_python rosserial_server",
    "ros-industrial/universal_robot": """ur_description ur_gazebo ur_kinematics ur3_moveit_config ur5_moveit_config
        ur10_moveit_config ur3e_moveit_config ur5e_moveit_config ur10e_moveit_config""",
    "ros-perception/image_pipeline": "camera_calibration depth_image_proc image_proc image_rotate stereo_image_proc",
    "ros-perception/slam_gmapping": "gmapping slam_gmapping",
    "ros-planning/moveit": """moveit_commander moveit_core moveit_kinematics moveit_planners_ompl moveit_ros_move_group
        moveit_ros_planning moveit_ros_planning_interface moveit_ros_visualization moveit_setup_assistant
        moveit_simple_controller_manager""",
    "ros-planning/navigation": """amcl base_local_planner carrot_planner clear_costmap_recovery costmap_2d
        dwa_local_planner fake_localization global_planner move_base navfn rotate_recovery""",
    "ros-simulation/gazebo_ros_demos": "gazebo_ros_demos rrbot_control rrbot_description rrbot_gazebo",
    "ros-simulation/stage_ros": "stage_ros",
    "tu-darmstadt-ros-pkg/hector_models": """hector_components_description hector_models hector_sensors_description
        hector_sensors_gazebo hector_xacro_tools""",
    "tu-darmstadt-ros-pkg/hector_quadrotor": """hector_quadrotor_controllers hector_quadrotor_demo
        hector_quadrotor_description hector_quadrotor_gazebo hector_quadrotor_teleop""",
    "tu-darmstadt-ros-pkg/hector_slam": "hector_geotiff hector_mapping hector_slam_launch hector_trajectory_server",
    "turtlebot/turtlebot": "turtlebot_bringup turtlebot_capabilities turtlebot_description turtlebot_teleop",
    "turtlebot/turtlebot_apps": "turtlebot_actions turtlebot_calibration turtlebot_follower turtlebot_navigation",
    "turtlebot/turtlebot_arm": "turtlebot_arm_bringup turtlebot_arm_description turtlebot_arm_moveit_config",
    "turtlebot/turtlebot_create": "create_description create_driver create_gazebo_plugins create_node",
    "turtlebot/turtlebot_simulator": "turtlebot_gazebo turtlebot_stage turtlebot_stdr",
    "yujinrobot/kobuki": "kobuki_auto_docking kobuki_bumper2pc kobuki_description kobuki_keyop kobuki_node",
    "yujinrobot/kobuki_desktop": "kobuki_dashboard kobuki_gazebo kobuki_gazebo_plugins kobuki_rviz_launchers",
}
"""GitHub owner/name → packages."""


def repository_hint(package: str) -> str:
    """Return '; it is published at …' for a missing package, or nothing."""
    for repository, packages in _REPOSITORIES.items():
        if package in packages.split():
            return f"; it is published at https://github.com/{repository}"
    return ""

"""Packages that are never fetched: Trundle replaces them, or they only serve to compile."""

_BUILD = """
    ament_cmake ament_package catkin cmake_modules cpp_common gencpp geneus genlisp genmsg gennodejs genpy
    message_generation message_runtime message_to_tf mk mrt_cmake_modules rosbuild roscompile roslang roslint rostest
    rosunit
"""
_GRAPH = """
    actionlib actionlib_msgs angles bond bondcpp bondpy class_loader control_msgs control_toolbox controller_interface
    controller_manager_msgs diagnostic_msgs diagnostic_updater diagnostics dynamic_reconfigure eigen_conversions
    eigen_stl_containers filters gazebo gazebo_dev gazebo_msgs gazebo_ros geometry geometry2 geometry_msgs
    hardware_interface image_transport interactive_markers joint_limits_interface kdl_conversions kdl_parser
    kdl_parser_py map_msgs message_filters move_base_msgs nav_msgs orocos_kdl pcl_msgs pluginlib python_orocos_kdl
    python_qt_binding realtime_tools resource_retriever robot ros ros_base ros_comm ros_control ros_controllers ros_core
    rosbag_migration_rule rosbag_storage rosclean rosconsole roscpp_serialization roscpp_traits rosgraph rosgraph_msgs
    roslz4 rospack rostime rqt rqt_common_plugins rqt_gui_cpp rqt_gui_py rqt_robot_plugins rviz_plugin_tutorials
    sensor_msgs shape_msgs smach smach_msgs smach_ros smclib std_msgs std_srvs stereo_msgs tf2 tf2_eigen
    tf2_geometry_msgs tf2_kdl tf2_msgs tf2_py tf2_sensor_msgs tf_conversions topic_tools trajectory_msgs
    transmission_interface urdf urdf_parser_plugin urdfdom urdfdom_py vision_msgs visualization_msgs xmlrpcpp
"""
_META = "common_msgs desktop desktop_full perception robot_model simulators viz"
BUILT_IN = frozenset(f"{_BUILD} {_GRAPH} {_META}".split())

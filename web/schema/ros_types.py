"""TypeScript types of the ROS messages that the client knows, from the definitions that Trundle ships."""

import textwrap

from page_types import comment

from trundle.ros import Messages

HEAD = """/** ROS messages that displays, tools and panels know, made by web/schema. */

import type { RosTime } from "../ros_types";
"""
ROS_MESSAGES = (
    "actionlib_msgs/GoalStatusArray",
    "geometry_msgs/AccelStamped",
    "geometry_msgs/PointStamped",
    "geometry_msgs/PolygonStamped",
    "geometry_msgs/PoseArray",
    "geometry_msgs/PoseStamped",
    "geometry_msgs/PoseWithCovarianceStamped",
    "geometry_msgs/TransformStamped",
    "geometry_msgs/TwistStamped",
    "geometry_msgs/WrenchStamped",
    "map_msgs/OccupancyGridUpdate",
    "move_base_msgs/MoveBaseActionFeedback",
    "move_base_msgs/RecoveryStatus",
    "moveit_msgs/ContactInformation",
    "moveit_msgs/DisplayRobotState",
    "moveit_msgs/DisplayTrajectory",
    "moveit_msgs/ExecuteTrajectoryActionResult",
    "moveit_msgs/MoveGroupActionFeedback",
    "moveit_msgs/MoveGroupActionResult",
    "moveit_msgs/PlannerInterfaceDescription",
    "moveit_msgs/PlanningScene",
    "nav_msgs/GridCells",
    "nav_msgs/OccupancyGrid",
    "nav_msgs/Odometry",
    "nav_msgs/Path",
    "sensor_msgs/CameraInfo",
    "sensor_msgs/CompressedImage",
    "sensor_msgs/FluidPressure",
    "sensor_msgs/Illuminance",
    "sensor_msgs/Image",
    "sensor_msgs/Imu",
    "sensor_msgs/JointState",
    "sensor_msgs/LaserScan",
    "sensor_msgs/PointCloud",
    "sensor_msgs/PointCloud2",
    "sensor_msgs/Range",
    "sensor_msgs/RelativeHumidity",
    "sensor_msgs/Temperature",
    "tf2_msgs/TFMessage",
    "visualization_msgs/InteractiveMarkerFeedback",
    "visualization_msgs/InteractiveMarkerInit",
    "visualization_msgs/InteractiveMarkerUpdate",
    "visualization_msgs/MarkerArray",
)
"""Those in them come along."""

ARRAYS = {
    "int8": "Int8Array", "uint8": "Uint8Array", "int16": "Int16Array", "uint16": "Uint16Array",
    "int32": "Int32Array", "uint32": "Uint32Array", "int64": "BigInt64Array", "uint64": "BigUint64Array",
    "float32": "Float32Array", "float64": "Float64Array", "byte": "Int8Array", "char": "Uint8Array",
}  # fmt: skip
SINGLE = {
    "bool": "boolean",
    "string": "string",
    "time": "RosTime",
    "duration": "RosTime",
    "int64": "bigint",
    "uint64": "bigint",
}


def ros_type(field: str) -> str:
    """Return the type of a field, as reader.ts decodes it."""
    base, is_array, _ = field.partition("[")
    single = base.rpartition("/")[2] if "/" in base else SINGLE.get(base, "number")
    if not is_array:
        return single
    return ARRAYS.get(base, f"readonly {single}[]")


def ros_messages() -> str:
    """Return the types of ROS messages, by their names without packages."""
    messages, known, waiting = Messages(), dict[str, dict[str, str]](), list(ROS_MESSAGES)
    while waiting:
        name = waiting.pop()
        if name not in known:
            known[name] = messages.fields(name)
            waiting += [base for field in known[name].values() if "/" in (base := field.partition("[")[0])]
    assert len({name.rpartition("/")[2] for name in known}) == len(known), "two messages have one name"
    lines = [HEAD]
    for name in sorted(known, key=lambda each: each.rpartition("/")[2]):
        constants = [f"{each} {value}" for each, (_, value) in messages.constants(name).items()]
        fields = [f"  readonly {field}: {ros_type(kind)};" for field, kind in known[name].items()]
        lines += comment("\n".join(textwrap.wrap(f"{name}: {', '.join(constants)}", 110)).rstrip(": "))
        lines += [f"export type {name.rpartition('/')[2]} = {{", *fields, "};", ""]
    return "\n".join(lines)

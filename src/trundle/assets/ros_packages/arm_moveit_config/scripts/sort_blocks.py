#!/usr/bin/env python3
"""Look at the table from above, and put each block onto the tray of its color."""

import math
import sys
from collections import deque

import moveit_commander
import numpy as np
import rospy
from geometry_msgs.msg import PoseStamped
from moveit_msgs.msg import Grasp, MoveItErrorCodes, PlaceLocation
from sensor_msgs.msg import CameraInfo, Image
from tf.transformations import quaternion_from_euler
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

FRAME = "world"
EYE = (0.55, 0.0, 1.3)  # the camera's place, looking down; up in the picture is +x [m]
TABLE_TOP = 0.2
BLOCK = 0.05
TRAYS = {"red": (-0.2, 0.46), "green": (0.02, 0.52), "blue": (0.24, 0.52)}
TRAY_TOP = 0.1
FINGERS = ["left_finger", "right_finger"]
OPEN, CLOSED = 0.04, 0.02  # of each finger; a block is 0.025 from the middle to its side [m]
TIP = 0.14  # from the hand's link to the tips of its fingers [m]


def stamped(x, y, z, yaw=0.0, roll=0.0):
    pose = PoseStamped()
    pose.header.frame_id = FRAME
    pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = x, y, z
    q = quaternion_from_euler(roll, 0.0, yaw)
    pose.pose.orientation.x, pose.pose.orientation.y = q[0], q[1]
    pose.pose.orientation.z, pose.pose.orientation.w = q[2], q[3]
    return pose


def colors_of(image):
    """Return a boolean picture for each color."""
    rgb = np.frombuffer(image.data, np.uint8).reshape(image.height, image.width, 3).astype(int)
    masks = {}
    for index, color in enumerate(("red", "green", "blue")):
        others = [rgb[..., other] for other in range(3) if other != index]
        masks[color] = (rgb[..., index] > 60) & (rgb[..., index] > 1.35 * np.maximum(*others))
    return masks


def regions(mask, smallest):
    """Yield the pixels (n, 2), row and column, of connected parts."""
    left = mask.copy()
    for start in np.argwhere(mask):
        if not left[tuple(start)]:
            continue
        left[tuple(start)] = False
        queue, pixels = deque([tuple(start)]), []
        while queue:
            row, column = queue.popleft()
            pixels.append((row, column))
            for r, c in ((row + 1, column), (row - 1, column), (row, column + 1), (row, column - 1)):
                if 0 <= r < mask.shape[0] and 0 <= c < mask.shape[1] and left[r, c]:
                    left[r, c] = False
                    queue.append((r, c))
        if len(pixels) >= smallest:
            yield np.array(pixels)


def blocks_in(image, info):
    """Return color, x, y and yaw of the blocks on the table."""
    depth = EYE[2] - TABLE_TOP - BLOCK
    fx, fy, cx, cy = info.K[0], info.K[4], info.K[2], info.K[5]
    found = []
    for color, mask in colors_of(image).items():
        for pixels in regions(mask, smallest=0.4 * (BLOCK * fx / depth) ** 2):
            points = np.column_stack(
                [EYE[0] - (pixels[:, 0] - cy) * depth / fy, EYE[1] - (pixels[:, 1] - cx) * depth / fx]
            )
            yaw = min(np.radians(np.arange(0, 90, 2)), key=lambda angle: box_area(points, angle))
            x, y = box_center(points, yaw)
            if 0.36 < x < 0.74 and abs(y) < 0.39:
                found.append((color, x, y, yaw))
    return found


def turned(points, yaw):
    c, s = math.cos(yaw), math.sin(yaw)
    return points @ np.array([[c, -s], [s, c]])


def box_area(points, yaw):
    return np.prod(np.ptp(turned(points, yaw), axis=0))


def box_center(points, yaw):
    local = turned(points, yaw)
    middle = (local.min(axis=0) + local.max(axis=0)) / 2
    return turned(middle, -yaw)


def posture(position, seconds):
    point = JointTrajectoryPoint(positions=[position] * 2, time_from_start=rospy.Duration.from_sec(seconds))
    return JointTrajectory(joint_names=FINGERS, points=[point])


def grasps(x, y, yaw):
    """Grasps from above, the fingers on two sides of the block."""
    result = []
    for turn in (0.0, math.pi / 2, -math.pi / 2, math.pi):
        grasp = Grasp()
        grasp.grasp_pose = stamped(x, y, TABLE_TOP + BLOCK / 2 - 0.01 + TIP, yaw + turn, roll=math.pi)
        grasp.pre_grasp_posture, grasp.grasp_posture = posture(OPEN, 0.8), posture(CLOSED, 1.0)
        for way, z in ((grasp.pre_grasp_approach, -1.0), (grasp.post_grasp_retreat, 1.0)):
            way.direction.header.frame_id, way.direction.vector.z = FRAME, z
            way.min_distance, way.desired_distance = 0.06, 0.1
        result.append(grasp)
    return result


def places(color, number):
    """Places on a color's tray, for the object's pose, with any turn."""
    x, y = TRAYS[color]
    result = []
    for turn in np.linspace(-math.pi, math.pi, 8, endpoint=False):
        place = PlaceLocation()
        place.place_pose = stamped(x, y + (-0.06, 0.06)[number % 2], TRAY_TOP + BLOCK / 2 + 0.004, turn)
        place.post_place_posture = posture(0.035, 0.8)
        for way, z in ((place.pre_place_approach, -1.0), (place.post_place_retreat, 1.0)):
            way.direction.header.frame_id, way.direction.vector.z = FRAME, z
            way.min_distance, way.desired_distance = 0.05, 0.1
        result.append(place)
    return result


def main():
    moveit_commander.roscpp_initialize(sys.argv)
    rospy.init_node("sort_blocks")
    arm = moveit_commander.MoveGroupCommander("arm", wait_for_servers=60)
    scene = moveit_commander.PlanningSceneInterface()
    arm.set_max_velocity_scaling_factor(1.0)
    arm.set_max_acceleration_scaling_factor(1.0)
    arm.set_planning_time(5.0)

    scene.add_box("table", stamped(0.55, 0.0, TABLE_TOP / 2), (0.4, 0.8, TABLE_TOP))
    for color, (x, y) in TRAYS.items():
        scene.add_box(f"{color}_tray", stamped(x, y, TRAY_TOP / 2), (0.16, 0.24, TRAY_TOP))
    scene.add_box("floor", stamped(0.0, 0.0, -0.011), (2.0, 2.0, 0.02))

    arm.set_joint_value_target([1.2, -0.6, 1.6, 0.0, 1.0, 0.0])  # out of the picture
    arm.go(wait=True)
    info = rospy.wait_for_message("/eye/camera_info", CameraInfo)
    found = blocks_in(rospy.wait_for_message("/eye/image_raw", Image), info)
    rospy.loginfo("%d blocks: %s", len(found), ", ".join(f"{c} at {x:.3f}, {y:.3f}" for c, x, y, _ in found))

    counts, sorted_blocks = dict.fromkeys(TRAYS, 0), 0
    for index, (_, x, y, yaw) in enumerate(found):
        scene.add_box(f"block_{index}", stamped(x, y, TABLE_TOP + BLOCK / 2, yaw), (BLOCK,) * 3)
    for index, (color, x, y, yaw) in enumerate(found):
        name = f"block_{index}"
        arm.set_support_surface_name("table")
        if arm.pick(name, grasps(x, y, yaw)) != MoveItErrorCodes.SUCCESS:
            rospy.logerr("%s: not picked", name)
            continue
        arm.set_support_surface_name(f"{color}_tray")
        if not arm.place(name, places(color, counts[color])):
            rospy.logerr("%s: not placed", name)
            continue
        counts[color] += 1
        sorted_blocks += 1
    arm.set_named_target("ready")
    arm.go(wait=True)
    rospy.loginfo("sorted %d of %d blocks: %s", sorted_blocks, len(found), counts)
    moveit_commander.roscpp_shutdown()


if __name__ == "__main__":
    main()

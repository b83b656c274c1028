"""Occupied space: octomap's bytes, and clouds of a depth sensor."""

from typing import Any

import numpy as np
import pytest
from tests.planning.arms import arm
from tests.planning.move_group.arm_graph import ARM, start_arm

from trundle.gazebo.nodes.pointcloud_to_laserscan import read_points
from trundle.planning.kinematics import Kinematics
from trundle.planning.move_group.occupancy import OccupancyGrid
from trundle.planning.move_group.scene import OctomapError, read_octomap
from trundle.ros import Messages


def _message(library: Messages, **octomap: Any) -> Any:
    fields = {"octomap": {"id": "OcTree", "binary": True, "resolution": 0.1, **octomap}}
    return library.new("octomap_msgs/OctomapWithPose", {"origin": {"orientation": {"w": 1.0}}, **fields})


def test_cubes_that_are_hit_come_back_from_the_trees_bytes(messages: Messages) -> None:
    generator = np.random.default_rng(1)
    points = generator.uniform(-3.0, 3.0, (200, 3))
    grid = OccupancyGrid(0.1)

    grid.insert(np.zeros(3), points)
    voxels = read_octomap(_message(messages, data=grid.binary()))

    wanted = {tuple(cell) for cell in np.floor(points / 0.1).astype(int).tolist()}
    found = {tuple(cell) for cell in np.floor(voxels.centers / 0.1).astype(int).tolist()}
    assert found == wanted
    np.testing.assert_allclose(voxels.sizes, 0.1)


def test_rays_that_pass_free_what_was_there(messages: Messages) -> None:
    del messages
    grid = OccupancyGrid(0.1)
    grid.insert(np.zeros(3), np.array([[1.05, 0.05, 0.05]]))
    assert len(grid.occupied()) == 1

    for _ in range(4):
        grid.insert(np.zeros(3), np.array([[2.05, 0.05, 0.05]]))

    assert len(grid.occupied()) == 1  # the nearer cube is free, the farther one is hit


def test_a_full_tree_has_its_occupied_leaves(messages: Messages) -> None:
    """One inner node with two leaves: child 0 occupied, child 7 free; each is half of the whole."""
    value = np.float32(0.5).tobytes()
    data = value + bytes([0b10000001]) + value + bytes([0]) + np.float32(-1.0).tobytes() + bytes([0])

    voxels = read_octomap(_message(messages, data=np.frombuffer(data, np.int8), binary=False))

    np.testing.assert_allclose(voxels.sizes, [0.1 * 2**15])
    np.testing.assert_allclose(voxels.centers, [[-0.1 * 2**14] * 3])


@pytest.mark.parametrize(
    ("octomap", "problem"),
    [
        ({"data": [0, 0, 3], "id": "OcTree"}, "ends inside a node"),
        ({"data": [-1] * 40}, "ends inside a node"),
        ({"data": [0, 0], "id": "QuadTree"}, "an octomap of type 'QuadTree'"),
        ({"data": [0, 0], "resolution": 0.0}, "a resolution of 0"),
    ],
)
def test_damaged_octomaps_are_refused(octomap: dict[str, Any], problem: str, messages: Messages) -> None:
    if octomap["data"] == [0, 0, 3]:
        octomap = {**octomap, "data": [3]}
    with pytest.raises(OctomapError, match=problem):
        read_octomap(_message(messages, **octomap))


def test_a_cloud_of_a_sensor_is_in_the_way(graph: Any) -> None:
    """A wall before the arm is seen; the arm itself, which the sensor sees as well, is not in its own way."""
    sensor = {
        "sensor_plugin": "occupancy_map_monitor/PointCloudOctomapUpdater",
        "point_cloud_topic": "/cloud",
        "max_range": 5.0,
        "padding_offset": 0.05,
        "filtered_cloud_topic": "filtered_cloud",
    }
    filtered = graph.listen("/move_group/filtered_cloud", "sensor_msgs/PointCloud2")
    start_arm(graph, sensors=[sensor], octomap_resolution=0.05)
    y, z = np.meshgrid(np.arange(-0.4, 0.4, 0.03), np.arange(0.0, 1.5, 0.03))
    wall = np.stack([np.full(y.size, 0.75), y.ravel(), z.ravel()], axis=1)
    own = np.array([[0.05, 0.0, 0.6], [0.0, 0.0, 0.1]])
    far = np.array([[9.0, 0.0, 0.5]])
    points = np.vstack([wall, own, far]).astype(np.float32)
    fields = [{"name": name, "offset": 4 * index, "datatype": 7, "count": 1} for index, name in enumerate("xyz")]
    cloud = {
        "header": {"frame_id": "base_link"},
        "height": 1,
        "width": len(points),
        "fields": fields,
        "point_step": 12,
        "row_step": 12 * len(points),
        "data": np.frombuffer(points.tobytes(), np.uint8),
        "is_dense": True,
    }
    clouds = graph.advertise("/cloud", "sensor_msgs/PointCloud2")
    graph.until(lambda: graph.connected("/move_group/filtered_cloud"))
    clouds.publish(cloud)
    get = "moveit_msgs/GetPlanningScene"
    scenes: list[Any] = []

    def is_seen() -> bool:
        scenes.append(graph.call("/get_planning_scene", get, components={"components": 32}).scene)
        return len(scenes[-1].world.octomap.octomap.data) > 0

    graph.until(is_seen)
    assert _validity(graph, [0.0, 0.0, 0.0, 0.0, 0.8, 0.0]).valid
    stretched = _validity(graph, [0.0, 0.7, -0.7, 0.0, 0.0, 0.0])
    assert not stretched.valid
    assert "<octomap>" in {stretched.contacts[0].contact_body_1, stretched.contacts[0].contact_body_2}
    graph.until(lambda: filtered)
    np.testing.assert_array_equal(read_points(filtered[0]), wall.astype(np.float32))
    assert filtered[0].header.frame_id == "base_link"
    graph.call("/clear_octomap", "std_srvs/Empty")
    assert _validity(graph, [0.0, 0.7, -0.7, 0.0, 0.0, 0.0]).valid


def _validity(graph: Any, positions: list[float]) -> Any:
    state = {"joint_state": {"name": ARM, "position": positions}, "is_diff": True}
    return graph.call("/check_state_validity", "moveit_msgs/GetStateValidity", robot_state=state, group_name="arm")


def test_what_a_depth_camera_sees_is_in_the_way(graph: Any) -> None:
    """A camera in the base looks up, its z axis, at a ceiling that the stretched arm touches; nearer is the arm."""
    sensor = {
        "sensor_plugin": "occupancy_map_monitor/DepthImageOctomapUpdater",
        "image_topic": "/camera/depth",
        "far_clipping_plane_distance": 5.0,
    }
    start_arm(graph, sensors=[sensor], octomap_resolution=0.05)
    model = arm("six_axis")
    up = Kinematics(model).link_pose(model.default_positions(), "tool0").position[2]
    depths = np.full((48, 64), up - 0.02, dtype=np.float32)
    depths[20:28, 28:36] = 0.5
    header = {"frame_id": "base_link"}
    image = {
        "header": header,
        "height": 48,
        "width": 64,
        "encoding": "32FC1",
        "step": 256,
        "data": np.frombuffer(depths.tobytes(), np.uint8),
    }
    cameras = graph.advertise("/camera/camera_info", "sensor_msgs/CameraInfo", latch=True)
    images = graph.advertise("/camera/depth", "sensor_msgs/Image", latch=True)
    cameras.publish({"header": header, "height": 48, "width": 64, "K": [40.0, 0, 32, 0, 40, 24, 0, 0, 1]})

    def is_seen() -> bool:
        images.publish(image)
        components = {"components": 32}
        scene = graph.call("/get_planning_scene", "moveit_msgs/GetPlanningScene", components=components).scene
        return len(scene.world.octomap.octomap.data) > 0

    graph.until(is_seen)
    stretched, bent = _validity(graph, [0.0] * 6), _validity(graph, [0.0, 0.3, 0.9, 0.0, 0.8, 0.0])

    assert not stretched.valid
    assert "<octomap>" in {stretched.contacts[0].contact_body_1, stretched.contacts[0].contact_body_2}
    assert bent.valid

"""Navigation's nodes on a graph: hostile maps, scans, poses and goals, one message each."""

from collections.abc import Generator
from concurrent.futures import Future
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from trundle.base.supervisor import ProcessTree
from trundle.gazebo.nodes import BuiltinReplacement, NodeHost, run_builtin_node
from trundle.gazebo.nodes.catalog import BUILTIN_NODES
from trundle.ros import Core, GraphLoop, Messages, Node, StaticTransformBroadcaster, Transform

from .target import Execute, Target

_PATIENCE_S = 60.0
_TOPICS = (
    ("/map", "nav_msgs/OccupancyGrid"),
    ("/map_updates", "map_msgs/OccupancyGridUpdate"),
    ("/scan", "sensor_msgs/LaserScan"),
    ("/initialpose", "geometry_msgs/PoseWithCovarianceStamped"),
    ("/move_base_simple/goal", "geometry_msgs/PoseStamped"),
    ("/move_base/goal", "move_base_msgs/MoveBaseActionGoal"),
    ("/odom", "nav_msgs/Odometry"),
    ("/clicked_point", "geometry_msgs/PointStamped"),
    ("/detected_points", "geometry_msgs/PointStamped"),
    ("/filtered_points", "rrt_exploration/PointArray"),
)
"""An input's first byte is a number here; the rest is a serialized message."""
_COSTMAP = {"robot_base_frame": "base_link", "footprint": "[[0.1, 0.1], [-0.1, 0.1], [-0.1, -0.1], [0.1, -0.1]]"}
_LAYERS = [{"name": "obstacles", "type": "costmap_2d::ObstacleLayer"}]
_SOURCE = {"observation_sources": "scan", "scan": {"topic": "/scan", "data_type": "LaserScan"}}
_NODES: tuple[tuple[str, str, dict[str, Any]], ...] = (
    ("amcl", "amcl", {"use_map_topic": True, "max_particles": 200}),
    ("gmapping", "slam_gmapping", {"particles": 2, "tf_delay": 0.5, "map_frame": "m1", "odom_frame": "odom"}),
    ("hector_mapping", "hector_mapping", {"map_size": 64, "pub_map_odom_transform": False}),
    ("slam_karto", "slam_karto", {"map_frame": "m2"}),
    ("laser_scan_matcher", "laser_scan_matcher_node", {"fixed_frame": "m3"}),
    ("explore_lite", "explore", {"costmap_topic": "map", "costmap_updates_topic": "map_updates"}),
    ("rrt_exploration", "global_rrt_detector", {"map_topic": "/map"}),
    ("rrt_exploration", "filter.py", {"global_costmap_topic": "/map"}),
    ("rrt_exploration", "assigner.py", {}),
    (
        "move_base",
        "move_base",
        {
            "global_costmap": {**_COSTMAP, "global_frame": "map", "static_map": True},
            "local_costmap": {
                **_COSTMAP,
                "global_frame": "odom",
                "rolling_window": True,
                "plugins": _LAYERS,
                "obstacles": _SOURCE,
            },
        },
    ),
)


@contextmanager
def _open(_: Path) -> Generator[Execute]:
    messages = Messages()
    tree = ProcessTree()
    with GraphLoop(messages=messages) as loop:
        core = Core(loop, port=0)
        loop.run(core.start(), _PATIENCE_S)
        client = Node("/client", loop=loop, master_uri=core.uri)
        frames = [("odom", "base_link"), ("base_link", "laser")]
        transforms = [Transform(parent=parent, child=child) for parent, child in frames]
        StaticTransformBroadcaster(client).send_transform(*transforms)
        publishers = [client.advertise(topic, kind, queue_size=None) for topic, kind in _TOPICS]
        running: dict[str, Future[int]] = {}
        for package, kind, params in _NODES:
            node = Node(kind.removesuffix(".py"), loop=loop, master_uri=core.uri, params=params)
            stand_in = BuiltinReplacement(BUILTIN_NODES[package, kind])
            running[kind] = loop.spawn(run_builtin_node(stand_in, node, [], NodeHost(tree=tree)))

        def execute(data: bytes) -> None:
            topic = data[0] % len(_TOPICS) if data else 0
            message = messages.deserialize(data[1:], _TOPICS[topic][1])
            publishers[topic].publish(message)
            loop.wait_idle()
            ended = [kind for kind, future in running.items() if future.done()]
            assert not ended, f"nodes ended: {ended}"

        yield execute
        for future in running.values():
            future.cancel()
        loop.run(core.stop(), _PATIENCE_S)
        tree.close()


def _seeds() -> list[bytes]:
    messages = Messages()
    level = {"orientation": {"w": 1.0}}
    info = {"resolution": 0.1, "width": 4, "height": 4, "origin": level}
    header = {"frame_id": "map"}
    pose = {"header": header, "pose": level}
    scan = {"header": {"frame_id": "laser"}, "angle_max": 3.0, "angle_increment": 0.5, "range_max": 5.0}
    fields: list[dict[str, Any]] = [
        {"header": header, "info": info, "data": [0, 100, -1, 0] * 4},
        {"header": header, "width": 2, "height": 2, "data": [0, 100, -1, 0]},
        {**scan, "ranges": [1.0, 2.0, float("nan"), float("inf"), 0.0, 3.0, 1.5]},
        {"header": header, "pose": {"pose": level, "covariance": [0.1] * 36}},
        pose,
        {"goal": {"target_pose": pose}},
        {"header": {"frame_id": "odom"}, "child_frame_id": "base_link", "pose": {"pose": level}},
        {"header": header, "point": {"x": 0.1, "y": 0.1}},
        {"header": header, "point": {"x": 0.1, "y": 0.1}},
        {"points": [{"x": 0.1, "y": 0.1}]},
    ]
    return [
        bytes([number]) + bytes(messages.serialize(messages.new(kind, values)))
        for number, ((_, kind), values) in enumerate(zip(_TOPICS, fields, strict=True))
    ]


TARGETS = {"navigation": Target(open=_open, seeds=_seeds, words=(b"map", b"odom", b"laser", b"\xff\xff\xff\x7f"))}

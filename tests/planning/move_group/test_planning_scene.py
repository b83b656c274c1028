"""The scene as topics and services change and show it."""

from typing import Any

from tests.planning.move_group.arm_graph import add, box, start_arm

_GET = "moveit_msgs/GetPlanningScene"
_OBJECTS, _ATTACHED, _MATRIX = 16, 4, 128


def _objects(graph: Any) -> dict[str, Any]:
    scene = graph.call("/get_planning_scene", _GET, components={"components": _OBJECTS}).scene
    return {item.id: item for item in scene.world.collision_objects}


def _attached(graph: Any) -> list[Any]:
    scene = graph.call("/get_planning_scene", _GET, components={"components": _ATTACHED}).scene
    return list(scene.robot_state.attached_collision_objects)


def test_an_object_goes_with_the_link_that_it_is_attached_to(graph: Any) -> None:
    start_arm(graph)
    add(graph, box("crate", 0.4, 0.1, 0.2, (0.1, 0.1, 0.1)), box("shelf", -0.5, 0.0, 0.5, (0.2, 0.2, 0.2)))
    attach = {"link_name": "tool0", "object": {"id": "crate"}, "touch_links": ["hand"]}

    add(graph, robot_state={"is_diff": True, "attached_collision_objects": [attach]})

    assert set(_objects(graph)) == {"shelf"}
    (held,) = _attached(graph)
    assert (held.object.id, held.link_name, held.object.header.frame_id) == ("crate", "tool0", "tool0")
    detach = {"link_name": "tool0", "object": {"id": "crate", "operation": 1}}
    add(graph, robot_state={"is_diff": True, "attached_collision_objects": [detach]})
    position = _objects(graph)["crate"].pose.position
    assert abs(position.x - 0.4) + abs(position.y - 0.1) + abs(position.z - 0.2) < 1e-6
    assert _attached(graph) == []


def test_changes_on_topics_are_published_as_diffs(graph: Any) -> None:
    start_arm(graph, planning_scene_monitor={"publish_planning_scene_hz": 20.0})
    scenes = graph.listen("/move_group/monitored_planning_scene", "moveit_msgs/PlanningScene")
    graph.until(lambda: scenes)
    objects = graph.advertise("/collision_object", "moveit_msgs/CollisionObject")

    objects.publish(box("crate", 0.4, 0.1, 0.2, (0.1, 0.1, 0.1)))
    graph.until(lambda: any(item.id == "crate" for scene in scenes for item in scene.world.collision_objects))
    objects.publish({"id": "crate", "operation": 1})
    graph.until(lambda: any(item.operation == 1 for scene in scenes for item in scene.world.collision_objects))

    assert not scenes[0].is_diff
    assert list(scenes[0].allowed_collision_matrix.entry_names) != []
    assert scenes[-1].is_diff
    assert _objects(graph) == {}


def test_an_invalid_object_is_refused_and_the_rest_stays(graph: Any) -> None:
    start_arm(graph)
    add(graph, box("crate", 0.4, 0.1, 0.2, (0.1, 0.1, 0.1)))
    wrong = [
        {**box("flat", 0.4, 0.1, 0.2, (0.1, 0.1, 0.1)), "primitives": [{"type": 1, "dimensions": [0.1]}]},
        {**box("lost", 0.4, 0.1, 0.2, (0.1, 0.1, 0.1)), "header": {"frame_id": "nowhere"}},
        {"id": "ghost", "operation": 1},
        {"id": "empty", "header": {"frame_id": "base_link"}},
        box("endless", 0.4, 0.1, float("nan"), (0.1, 0.1, 0.1)),
    ]

    for item in wrong:
        scene = {"is_diff": True, "robot_state": {"is_diff": True}, "world": {"collision_objects": [item]}}
        assert not graph.call("/apply_planning_scene", "moveit_msgs/ApplyPlanningScene", scene=scene).success

    assert set(_objects(graph)) == {"crate"}


def test_collisions_that_a_matrix_allows_are_none(graph: Any) -> None:
    start_arm(graph)
    add(graph, box("crate", 0.0, 0.0, 0.1, (0.3, 0.3, 0.1)))
    state = {"is_diff": True}
    kind = "moveit_msgs/GetStateValidity"
    before = graph.call("/check_state_validity", kind, robot_state=state, group_name="")
    matrix = graph.call("/get_planning_scene", _GET, components={"components": _MATRIX}).scene.allowed_collision_matrix
    matrix.default_entry_names, matrix.default_entry_values = ["crate"], [True]

    add(graph, allowed_collision_matrix=matrix)

    assert {before.contacts[0].contact_body_1, before.contacts[0].contact_body_2} == {"base_link", "crate"}
    assert graph.call("/check_state_validity", kind, robot_state=state, group_name="").valid


def test_the_offset_of_a_plane_goes_along_its_normal(graph: Any) -> None:
    """As in MoveIt, whose FCL has n·x = d, against the comment of shape_msgs/Plane."""
    start_arm(graph)
    plane = {"id": "floor", "header": {"frame_id": "base_link"}, "plane_poses": [{"orientation": {"w": 1.0}}]}
    kind = "moveit_msgs/GetStateValidity"

    add(graph, {**plane, "planes": [{"coef": [0.0, 0.0, 2.0, -0.4]}]})
    below = graph.call("/check_state_validity", kind, robot_state={"is_diff": True}, group_name="")
    add(graph, {**plane, "planes": [{"coef": [0.0, 0.0, 2.0, 0.4]}]})
    above = graph.call("/check_state_validity", kind, robot_state={"is_diff": True}, group_name="")

    assert below.valid
    assert not above.valid
    assert "floor" in {above.contacts[0].contact_body_1, above.contacts[0].contact_body_2}


def test_constraints_of_sight_are_checked(graph: Any) -> None:
    start_arm(graph)
    kind = "moveit_msgs/GetStateValidity"
    sight = {
        "target_radius": 0.05,
        "target_pose": {"header": {"frame_id": "tool0"}, "pose": {"position": {"z": 0.5}, "orientation": {"x": 1.0}}},
        "sensor_pose": {
            "header": {"frame_id": "tool0"},
            "pose": {"position": {"z": 0.15}, "orientation": {"w": 1.0}},
        },
        "cone_sides": 6,
        "max_range_angle": 0.3,
        "weight": 1.0,
    }

    def ask(**changes: Any) -> Any:
        constraints = {"visibility_constraints": [{**sight, **changes}]}
        answer = graph.call(
            "/check_state_validity",
            kind,
            robot_state={"is_diff": True},
            group_name="arm",
            constraints=constraints,
        )
        return answer.valid, [one.result for one in answer.constraint_result]

    behind = {"header": {"frame_id": "tool0"}, "pose": {"position": {"z": -0.5}, "orientation": {"w": 1.0}}}
    assert ask() == (True, [True])
    assert ask(target_pose=behind) == (False, [False])

"""Goals of an action's client reach a server that comes late."""

from collections.abc import Callable
from typing import Any

import pytest
from tests.graphs import running_graph, until

from trundle.ros import ABORTED, ActionClient, ActionResult, ActionServer

TYPE = "move_base_msgs/MoveBase"


@pytest.mark.parametrize("status", ["succeeded", "aborted"])
def test_a_goal_is_sent_again_to_a_server_that_comes_late(status: Any) -> None:
    """A recorder receives goals, too, and is no server."""
    received: list[float] = []
    states: list[int] = []
    feedback: list[Any] = []

    async def execute(goal: Any, accept: Callable[[], None]) -> ActionResult:
        received.append(goal.target_pose.pose.position.x)
        accept()
        server.publish_feedback({"base_position": {"pose": {"position": {"x": 7.0}}}})
        return ActionResult(status=status)

    with running_graph() as graph:
        recorder, node, late = graph.node("/recorder"), graph.node("/explorer"), graph.node("/driver")
        heard: list[Any] = []
        recorder.subscribe("/drive/goal", f"{TYPE}ActionGoal", heard.append)
        client = ActionClient(node, "/drive", TYPE)
        until(lambda: any(link[4] == "/drive/goal" for link in node.endpoints.connections()))
        client.send({"target_pose": {"pose": {"position": {"x": 3.0}}}}, states.append, feedback.append)
        until(lambda: heard)
        assert not client.has_server

        server = ActionServer(late, "/drive", TYPE, execute)
        until(lambda: states)
        assert received == [3.0]
        assert states == [ABORTED if status == "aborted" else 3]
        assert [message.base_position.pose.position.x for message in feedback] in ([], [7.0])
        assert client.has_server
        graph.ready(recorder, node, late)


def test_the_end_of_a_cancelled_goal_is_not_reported() -> None:
    states: list[int] = []
    ends: list[str] = []

    async def execute(_goal: Any, accept: Callable[[], None]) -> ActionResult:
        accept()
        try:
            await never.wait()
        finally:
            ends.append("cancelled")
        return ActionResult()

    with running_graph() as graph:
        node = graph.node("/explorer")
        client = ActionClient(node, "/drive", TYPE)
        never = node.closed
        server = ActionServer(node, "/drive", TYPE, execute)
        until(lambda: client.has_server)
        client.send({}, states.append)
        until(lambda: server.active)
        client.cancel()
        until(lambda: ends)
        assert states == []
        graph.ready(node)


def test_a_cancellation_is_sent_again_until_the_server_hears_it() -> None:
    """The topics of an action are connected one after the other: a goal may run before cancellations are heard."""
    with running_graph() as graph:
        node, other = graph.node("/explorer"), graph.node("/driver")
        client = ActionClient(node, "/drive", TYPE)
        goals: list[Any] = []
        cancelled: list[str] = []
        other.subscribe("/drive/goal", f"{TYPE}ActionGoal", goals.append)
        status = other.advertise("/drive/status", "actionlib_msgs/GoalStatusArray", queue_size=None)

        def is_running() -> bool:
            listed = [{"goal_id": {"id": goals[0].goal_id.id}, "status": 1}] if goals else []
            status.publish({"status_list": listed})
            return client.has_server

        until(is_running)
        client.send({}, lambda _state: None)
        until(lambda: goals)
        client.cancel()
        other.subscribe("/drive/cancel", "actionlib_msgs/GoalID", lambda message: cancelled.append(message.id))
        until(lambda: is_running() and cancelled)
        assert cancelled[0] == goals[0].goal_id.id


@pytest.mark.parametrize("remapped", ["client", "server"])
def test_a_remapping_of_an_actions_name_holds_for_its_topics(remapped: str) -> None:
    """As actionlib's, whose topics are in the namespace of the remapped name."""
    states: list[int] = []

    async def execute(_goal: Any, accept: Callable[[], None]) -> ActionResult:
        accept()
        return ActionResult()

    with running_graph() as graph:
        names = {"client": "/drive", "server": "/drive", remapped: "/go"}
        nodes = {end: graph.node(f"/{end}", remappings={"/go": "/drive"} if end == remapped else {}) for end in names}
        client = ActionClient(nodes["client"], names["client"], TYPE)
        ActionServer(nodes["server"], names["server"], TYPE, execute)
        until(lambda: client.has_server)
        client.send({}, states.append)
        until(lambda: states)
        assert states == [3]
        graph.ready(*nodes.values())


def test_a_cancellation_that_comes_before_its_goal_recalls_it() -> None:
    """Goals and cancellations come on two connections, in any order."""
    worked: list[str] = []

    async def execute(goal: Any, accept: Callable[[], None]) -> ActionResult:
        accept()
        worked.append(goal.target_pose.header.frame_id)
        await never.wait()
        return ActionResult()

    with running_graph() as graph:
        node = graph.node("/driver")
        never = node.closed
        server = ActionServer(node, "/drive", TYPE, execute)
        results: list[Any] = []
        node.subscribe("/drive/result", f"{TYPE}ActionResult", results.append)
        goals = node.advertise("/drive/goal", f"{TYPE}ActionGoal")
        cancels = node.advertise("/drive/cancel", "actionlib_msgs/GoalID")
        until(lambda: goals.has_subscribers and cancels.has_subscribers)
        goals.publish({"goal_id": {"id": "probe"}, "goal": {"target_pose": {"header": {"frame_id": "probe"}}}})
        until(lambda: server.active)

        cancels.publish({"id": "early"})
        cancels.publish({"id": "probe"})
        until(lambda: results)
        goals.publish({"goal_id": {"id": "early"}})
        until(lambda: len(results) == 2)

        assert worked == ["probe"]
        assert [(one.status.goal_id.id, one.status.status) for one in results] == [("probe", 2), ("early", 8)]
        graph.ready(node)


def test_goals_that_replace_each_other_at_once_all_have_a_result() -> None:
    async def execute(_goal: Any, accept: Callable[[], None]) -> ActionResult:
        accept()
        return ActionResult()

    with running_graph() as graph:
        node = graph.node("/driver")
        ActionServer(node, "/drive", TYPE, execute)
        ended: list[str] = []
        node.subscribe(
            "/drive/result", f"{TYPE}ActionResult", lambda m: ended.append(m.status.goal_id.id), queue_size=None
        )
        goals = node.advertise("/drive/goal", f"{TYPE}ActionGoal", queue_size=None)
        until(lambda: goals.has_subscribers)
        for number in range(20):
            goals.publish({"goal_id": {"id": str(number)}})
        until(lambda: len(ended) == 20)
        graph.ready(node)

        assert sorted(ended, key=int) == [str(number) for number in range(20)]


def test_a_goal_whose_work_fails_has_a_result(capfd: pytest.CaptureFixture[str]) -> None:
    """A client that waits for it would wait forever."""

    async def execute(_goal: Any, accept: Callable[[], None]) -> ActionResult:
        accept()
        raise KeyError("left")

    with running_graph() as graph:
        node = graph.node("/driver")
        ActionServer(node, "/drive", TYPE, execute)
        results: list[Any] = []
        node.subscribe("/drive/result", f"{TYPE}ActionResult", results.append)
        goals = node.advertise("/drive/goal", f"{TYPE}ActionGoal")
        until(lambda: goals.has_subscribers)
        goals.publish({"goal_id": {"id": "one"}})
        until(lambda: results)
        graph.ready(node)

    assert (results[0].status.status, results[0].status.text) == (4, "KeyError: 'left'")
    assert "/drive: KeyError: 'left'" in capfd.readouterr().err

"""tf2_web_republisher: transforms as action feedback and on requested topics."""

TF = "tf2_msgs/TFMessage"
ACTION = "tf2_web_republisher/TFSubscriptionAction"


def _message(x: float) -> dict[str, object]:
    transform = {"translation": {"x": x}, "rotation": {"w": 1.0}}
    return {
        "transforms": [
            {"header": {"stamp": "now", "frame_id": "map"}, "child_frame_id": "base", "transform": transform}
        ]
    }


REQUEST = {"source_frames": ["/base", "none"], "target_frame": "map", "rate": 50.0}


def test_feedback_has_the_transforms_that_changed(graph) -> None:
    graph.start("tf2_web_republisher/tf2_web_republisher")
    feedback = graph.listen("/tf2_web_republisher/feedback", f"{ACTION}Feedback")
    results = graph.listen("/tf2_web_republisher/result", f"{ACTION}Result")
    source = graph.advertise("/tf", TF)
    goals = graph.advertise("/tf2_web_republisher/goal", f"{ACTION}Goal")
    cancels = graph.advertise("/tf2_web_republisher/cancel", "actionlib_msgs/GoalID")
    graph.until(lambda: graph.connected("/tf2_web_republisher/feedback"))
    source.publish(_message(1.0))
    goals.publish({"goal_id": {"id": "few"}, "goal": {**REQUEST, "trans_thres": 0.1, "angular_thres": 0.1}})
    graph.until(lambda: feedback)
    source.publish(_message(1.05))
    source.publish(_message(2.0))
    graph.until(lambda: len(feedback) == 2)
    cancels.publish({"id": "few"})
    graph.until(lambda: results)

    assert [m.feedback.transforms[0].transform.translation.x for m in feedback] == [1.0, 2.0]
    assert all(m.status.goal_id.id == "few" for m in feedback)
    first = feedback[0].feedback.transforms[0]
    assert (first.header.frame_id, first.child_frame_id) == ("map", "base")


def test_each_goal_gets_its_own_feedback(graph) -> None:
    graph.start("tf2_web_republisher/tf2_web_republisher")
    feedback = graph.listen("/tf2_web_republisher/feedback", f"{ACTION}Feedback")
    source = graph.advertise("/tf", TF)
    goals = graph.advertise("/tf2_web_republisher/goal", f"{ACTION}Goal")
    graph.until(lambda: graph.connected("/tf2_web_republisher/feedback"))
    source.publish(_message(1.0))
    goals.publish({"goal_id": {"id": "forward"}, "goal": REQUEST})
    goals.publish({"goal_id": {"id": "back"}, "goal": {**REQUEST, "source_frames": ["map"], "target_frame": "base"}})
    graph.until(lambda: {m.status.goal_id.id for m in feedback} == {"forward", "back"})

    children = {(m.status.goal_id.id, m.feedback.transforms[0].child_frame_id) for m in feedback}
    assert children == {("forward", "base"), ("back", "map")}


def test_a_requested_topic_ends_without_subscribers(graph) -> None:
    graph.start("tf2_web_republisher/tf2_web_republisher")
    source = graph.advertise("/tf", TF)
    source.publish(_message(3.0))
    service_type = "tf2_web_republisher/RepublishTFs"
    topic = graph.call("/republish_tfs", service_type, **REQUEST, timeout={"secs": 2}).topic_name
    arrays = graph.listen(topic, "tf2_web_republisher/TFArray")
    graph.until(lambda: arrays)
    unused = graph.call("/republish_tfs", service_type, **REQUEST, timeout={"nsecs": 1}).topic_name

    assert arrays[0].transforms[0].transform.translation.x == 3.0

    def topics() -> set[str]:
        return {name for name, _ in graph.loop.run(graph.client.master.call("getSystemState"))[0]}

    graph.until(lambda: unused not in topics())
    assert topic in topics()

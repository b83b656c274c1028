"""tf2_web_republisher: transforms as feedback of an action, and on topics of their own."""

TF = "tf2_msgs/TFMessage"
ACTION = "tf2_web_republisher/TFSubscriptionAction"


def _message(x: float) -> dict[str, object]:
    transform = {"translation": {"x": x}, "rotation": {"w": 1.0}}
    return {
        "transforms": [
            {"header": {"stamp": "now", "frame_id": "map"}, "child_frame_id": "base", "transform": transform}
        ]
    }


ASKED = {"source_frames": ["/base", "none"], "target_frame": "map", "rate": 50.0}


def test_an_action_is_fed_what_has_moved(stage) -> None:
    stage.start("tf2_web_republisher/tf2_web_republisher")
    heard = stage.listen("/tf2_web_republisher/feedback", f"{ACTION}Feedback")
    results = stage.listen("/tf2_web_republisher/result", f"{ACTION}Result")
    source = stage.speak("/tf", TF)
    goals = stage.speak("/tf2_web_republisher/goal", f"{ACTION}Goal")
    cancels = stage.speak("/tf2_web_republisher/cancel", "actionlib_msgs/GoalID")
    stage.until(lambda: stage.connected("/tf2_web_republisher/feedback"))
    source.publish(_message(1.0))
    goals.publish({"goal_id": {"id": "few"}, "goal": {**ASKED, "trans_thres": 0.1, "angular_thres": 0.1}})
    stage.until(lambda: heard)
    source.publish(_message(1.05))
    source.publish(_message(2.0))
    stage.until(lambda: len(heard) == 2)
    cancels.publish({"id": "few"})
    stage.until(lambda: results)

    assert [m.feedback.transforms[0].transform.translation.x for m in heard] == [1.0, 2.0]
    assert all(m.status.goal_id.id == "few" for m in heard)
    first = heard[0].feedback.transforms[0]
    assert (first.header.frame_id, first.child_frame_id) == ("map", "base")


def test_goals_are_fed_each_its_own(stage) -> None:
    stage.start("tf2_web_republisher/tf2_web_republisher")
    heard = stage.listen("/tf2_web_republisher/feedback", f"{ACTION}Feedback")
    source = stage.speak("/tf", TF)
    goals = stage.speak("/tf2_web_republisher/goal", f"{ACTION}Goal")
    stage.until(lambda: stage.connected("/tf2_web_republisher/feedback"))
    source.publish(_message(1.0))
    goals.publish({"goal_id": {"id": "there"}, "goal": ASKED})
    goals.publish({"goal_id": {"id": "back"}, "goal": {**ASKED, "source_frames": ["map"], "target_frame": "base"}})
    stage.until(lambda: {m.status.goal_id.id for m in heard} == {"there", "back"})

    children = {(m.status.goal_id.id, m.feedback.transforms[0].child_frame_id) for m in heard}
    assert children == {("there", "base"), ("back", "map")}


def test_a_request_gets_a_topic_until_nobody_listens(stage) -> None:
    stage.start("tf2_web_republisher/tf2_web_republisher")
    source = stage.speak("/tf", TF)
    source.publish(_message(3.0))
    kind = "tf2_web_republisher/RepublishTFs"
    topic = stage.call("/republish_tfs", kind, **ASKED, timeout={"secs": 2}).topic_name
    heard = stage.listen(topic, "tf2_web_republisher/TFArray")
    stage.until(lambda: heard)
    unheard = stage.call("/republish_tfs", kind, **ASKED, timeout={"nsecs": 1}).topic_name

    assert heard[0].transforms[0].transform.translation.x == 3.0

    def topics() -> set[str]:
        return {name for name, _ in stage.loop.run(stage.client.master.call("getSystemState"))[0]}

    stage.until(lambda: unheard not in topics())
    assert topic in topics()

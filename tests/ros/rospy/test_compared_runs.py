"""Comparison of a program's runs: times and numbers that differ from run to run are masked."""

from tests.ros.rospy.compared_runs import mask, masked


def test_numbers_are_masked_and_no_topic_hides_another() -> None:
    seen = {
        "found": True,
        "publishers": [["/turtle1/pose", "turtlesim/Pose"], ["/turtle2/pose", "turtlesim/Pose"]],
        "messages": {"/turtle2/pose": ["x: 2.5\nsecs: 17"], "/turtle1/pose": ['x: 1\ntext: "caf\u00e9 \u001b[0m"']},
        "answers": {"/turtle1/spawn": ["name: a"], "/turtle2/spawn": []},
    }

    assert masked(seen) == {
        "found": True,
        "publishers": [["/turtle #/pose", "turtlesim/Pose"]] * 2,
        "messages": {"/turtle #/pose": ["x: #", 'text: "caf\u00e9 \u001b[ #m"', "x: #", "secs: #"]},
        "values": {"/turtle #/pose": ["x: 1", 'text: "caf\u00e9 \u001b[0m"', "x: 2.5", "secs #"]},
        "answers": {"/turtle #/spawn": ["name: a"]},
    }


def test_a_traceback_is_its_last_line() -> None:
    """The lines between differ from one interpreter to the other."""
    text = 'before 1\nTraceback (most recent call last):\n  File "/a/b.py", line 3\nKeyError: 5\nbefore 2\n'

    assert mask(text) == ["before #", "Traceback (most recent call last):", "KeyError: #"]

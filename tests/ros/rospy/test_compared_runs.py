"""Comparison of a program's runs, with numbers masked that differ from run to run."""

from tests.ros.rospy.compared_runs import mask, masked


def test_numbers_are_masked_and_topics_with_numbers_are_merged() -> None:
    observed = {
        "has_settled": True,
        "publishers": [["/turtle1/pose", "turtlesim/Pose"], ["/turtle2/pose", "turtlesim/Pose"]],
        "messages": {"/turtle2/pose": ["x: 2.5\nsecs: 17"], "/turtle1/pose": ['x: 1\ntext: "caf\u00e9 \u001b[0m"']},
        "responses": {"/turtle1/spawn": ["name: a"], "/turtle2/spawn": []},
    }

    assert masked(observed) == {
        "has_settled": True,
        "publishers": [["/turtle #/pose", "turtlesim/Pose"]] * 2,
        "messages": {"/turtle #/pose": ["x: #", 'text: "caf\u00e9 \u001b[ #m"', "x: #", "secs: #"]},
        "values": {"/turtle #/pose": ["x: 1", 'text: "caf\u00e9 \u001b[0m"', "x: 2.5", "secs #"]},
        "responses": {"/turtle #/spawn": ["name: a"]},
    }


def test_only_the_last_line_of_a_traceback_is_compared() -> None:
    """The other lines differ between interpreters."""
    text = 'before 1\nTraceback (most recent call last):\n  File "/a/b.py", line 3\nKeyError: 5\nbefore 2\n'

    assert mask(text) == ["before #", "Traceback (most recent call last):", "KeyError: #"]

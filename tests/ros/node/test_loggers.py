"""Levels of loggers, by name."""

import pytest

from trundle.ros import Loggers


def test_a_logger_has_the_level_of_the_nearest_above_it() -> None:
    loggers = Loggers.for_roscpp("topic_tools")
    assert loggers.level == "info"
    loggers.set("ros", "debug")
    levels = dict(loggers.levels())
    assert loggers.level == levels["ros.topic_tools"] == levels["ros.roscpp.roscpp_internal"] == "debug"
    assert levels["ros.roscpp.superdebug"] == "warn"
    loggers.set("ros.topic_tools", "error")
    assert loggers.level == "error"


def test_loggers_that_a_node_does_not_use_leave_it_alone() -> None:
    loggers = Loggers.for_rospy()
    loggers.set("rospy", "fatal")
    loggers.set("mine.own", "debug")
    levels = dict(loggers.levels())
    assert (loggers.level, levels["rospy.topics"], levels["mine.own"]) == ("info", "fatal", "debug")


def test_a_level_that_is_none_is_refused() -> None:
    with pytest.raises(ValueError, match="no level 'loud'; levels: debug, info"):
        Loggers.for_rospy().set("rosout", "loud")

"""Levels of loggers, by name."""

import pytest

from trundle.ros import Loggers


def test_a_logger_inherits_the_level_of_its_nearest_ancestor() -> None:
    loggers = Loggers.for_roscpp("topic_tools")
    assert loggers.level == "info"
    loggers.set("ros", "debug")
    levels = dict(loggers.levels())
    assert loggers.level == levels["ros.topic_tools"] == levels["ros.roscpp.roscpp_internal"] == "debug"
    assert levels["ros.roscpp.superdebug"] == "warn"
    loggers.set("ros.topic_tools", "error")
    assert loggers.level == "error"


def test_levels_of_other_loggers_do_not_change_the_nodes_level() -> None:
    loggers = Loggers.for_rospy()
    loggers.set("rospy", "fatal")
    loggers.set("mine.own", "debug")
    levels = dict(loggers.levels())
    assert (loggers.level, levels["rospy.topics"], levels["mine.own"]) == ("info", "fatal", "debug")


def test_an_unknown_level_is_refused() -> None:
    with pytest.raises(ValueError, match="no level 'loud'; levels: debug, info"):
        Loggers.for_rospy().set("rosout", "loud")

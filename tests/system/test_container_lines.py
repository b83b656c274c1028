"""Command lines that run a missing node's real program in a container."""

import re
import shlex
from itertools import pairwise
from pathlib import Path

LAUNCH = """<launch>
  <node pkg="rtabmap_ros" type="rtabmap" name="planner" ns="r1" args="-v 'two words'">
    <remap from="goal" to="/elsewhere/goal"/>
    <param name="rate" value="5"/>
  </node>
</launch>"""
REAL = """#!/usr/bin/env python3
import rospy
rospy.init_node("its_own_name")
print(rospy.get_name(), rospy.get_param("~rate"), rospy.resolve_name("goal"), rospy.myargv()[1:])
"""


def test_a_container_line_has_the_nodes_name_parameters_and_remappings(start, trundle, until, tmp_path: Path) -> None:
    """A local program replaces the program in the container."""
    program = tmp_path / "installed/rtabmap_ros/scripts/rtabmap"
    program.parent.mkdir(parents=True)
    (program.parents[1] / "package.xml").write_text("<package><name>rtabmap_ros</name></package>")
    program.write_text(REAL)
    program.chmod(0o755)
    (tmp_path / "a.launch").write_text(LAUNCH)
    launch = start("launch", "a.launch", "--headless", "--no-summary", ROS_HOSTNAME="127.0.0.1")
    until("the table", lambda: "missing  /r1/planner" in launch.output())

    match = re.search(r"docker run --rm -it --network host .*", launch.output().partition("WHAT RUNS")[2])
    assert match is not None
    *outside, script = shlex.split(match[0])
    variables = dict(word.split("=", 1) for before, word in pairwise(outside) if before == "-e")
    *_, (program_name, *words) = [shlex.split(part) for part in script.split(" && ")]
    assert program_name == "rosrun"
    assert set(variables) == {"ROS_MASTER_URI", "ROS_HOSTNAME"}
    process = trundle("exec", *words, ROS_PACKAGE_PATH=str(tmp_path / "installed"), **variables)

    assert process.stdout.splitlines()[0] == "/r1/planner 5 /elsewhere/goal ['-v', 'two words']", process.stderr
    assert launch.interrupt() == 130

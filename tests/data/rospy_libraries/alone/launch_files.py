"""Launch files read by roslaunch's loader, as tools that draw or check them do."""

import os
import tempfile

import roslaunch
import roslaunch.config
import roslaunch.core
import roslaunch.xmlloader
from roslaunch.core import Machine, Node, Param, RLException, Test

ROBOT = """<launch>
  <arg name="robot" default="rover"/>
  <arg name="wheels"/>
  <param name="wheels" value="$(arg wheels)"/>
  <param name="title" value="a long text that the summary shortens" type="str"/>
  <rosparam>{gains: {p: 1.5, i: [1, 2]}, ready: true}</rosparam>
  <group ns="$(arg robot)" clear_params="true">
    <remap from="cmd_vel" to="/teleop/cmd_vel"/>
    <env name="SPEED" value="fast"/>
    <node pkg="drive" type="drive_node" name="drive" args="--rate 10" output="screen" respawn="true" respawn_delay="2"
      launch-prefix="nice" cwd="node">
      <param name="radius" value="0.25"/>
      <remap from="odom" to="odometry"/>
    </node>
    <include file="$(dirname)/arm.launch"><arg name="joints" value="$(eval 2 * 3)"/></include>
  </group>
  <node pkg="camera" type="camera.py" name="eye" required="true" unless="false"/>
  <node pkg="lamp" type="lamp" name="lamp" if="false"/>
  <test pkg="drive" type="check.py" test-name="moves" time-limit="20" retry="2"/>
</launch>"""
ARM = """<launch>
  <arg name="joints"/>
  <node pkg="arm" type="arm" name="arm" args="$(arg joints)"/>
</launch>"""


def show(config, folder):
    """Print what was read."""
    for node in config.nodes:
        print(node.package, node.type, node.name, node.namespace, repr(node.args), node.output, node.cwd)
        print("  ", node.respawn, node.respawn_delay, node.required, node.launch_prefix, node.machine_name)
        print("  ", sorted(node.remap_args), sorted(map(list, node.env_args)), node.machine is not None)
    for test in config.tests:
        print(test.test_name, test.package, test.type, test.time_limit, test.retry)
    for name, param in sorted(config.params.items()):
        if name not in ("/rosversion", "/rosdistro"):
            print(name, repr(param.value), param.key)
    print([path.replace(folder, "") for path in config.roslaunch_files if "roscore" not in path])
    print(config.clear_params, config.resolved_node_names)


with tempfile.TemporaryDirectory() as folder:
    robot = os.path.join(folder, "robot.launch")
    for name, text in (("robot.launch", ROBOT), ("arm.launch", ARM)):
        with open(os.path.join(folder, name), "w") as file:
            file.write(text)

    config = roslaunch.config.ROSLaunchConfig()
    roslaunch.xmlloader.XmlLoader().load(robot, config, argv=["wheels:=4"], verbose=False)
    show(config, folder)
    config.assign_machines()
    print(config.summary(local=True))
    print(config.has_remote_nodes())

    config = roslaunch.config.load_config_default([(robot, ["wheels:=6", "robot:=big"])], 11999)
    show(config, folder)
    print([(node.package, node.type, node.name) for node in config.nodes_core], config.master.get_port())

    config = roslaunch.config.ROSLaunchConfig()
    roslaunch.xmlloader.XmlLoader().load_string('<launch><node pkg="a" type="b" name="c"/></launch>', config)
    show(config, folder)
    for fault in (
        "<launch><node pkg='a' name='c'/></launch>",
        "<launch><param name='x'/></launch>",
        "<robot/>",
        "<launch",
    ):
        try:
            roslaunch.xmlloader.XmlLoader().load_string(fault, roslaunch.config.ROSLaunchConfig(), verbose=False)
        except roslaunch.xmlloader.XmlParseException as error:
            print(type(error).__name__, isinstance(error, RLException))
    try:
        roslaunch.config.load_config_default([robot], None)
    except RLException as error:
        print("refused", "wheels" in str(error))

config = roslaunch.config.ROSLaunchConfig()
config.add_node(Node("a", "b", name="c", namespace="ns"))
try:
    config.add_node(Node("a", "b", name="c", namespace="/ns/"))
except RLException as error:
    print(error)
config.add_param(Param("x//y/", 3))
config.add_param(Param("x/y/z", 4), verbose=False)
config.add_clear_param("/old/")
print(config.params, config.config_errors, config.nodes[0].namespace)
print(config.add_machine(Machine("far", "10.0.0.2", env_loader="/e.sh", user="me")))
print(config.add_machine(Machine("far", "10.0.0.2", env_loader="/e.sh", user="me")), sorted(config.machines))
print(config.machines["far"], Machine("a", "b") == Machine("a", "b"), Machine("a", "b") == Machine("a", "c"))
print(config.summary())
for wrong in (
    lambda: Node("", "b"), lambda: Node("a", " "), lambda: Node("a", "b", name="x/y"),
    lambda: Node("a", "b", respawn=True, required=True), lambda: Node("a", "b", output="loud"),
    lambda: Test("t", "a", "b", time_limit=-1),
):  # fmt: skip
    try:
        wrong()
    except ValueError as error:
        print(error)
print([roslaunch.config.namespaces_of(name) for name in ("", "/", "/a/b/c", "a/b")])

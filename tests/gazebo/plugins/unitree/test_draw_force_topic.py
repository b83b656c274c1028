"""Force on a foot, over its topic, as a line on the page."""

import pytest
from tests.gazebo_server import Gazebo, until

from trundle.page.simulated_world.lines import plugin_lines

_FOOT = """<sdf version="1.6"><model name="foot"><link name="l"><pose>0 0 0.1 0 0 0</pose>
<inertial><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
<visual name="v"><geometry><sphere><radius>0.1</radius></sphere></geometry>
<plugin name="draw" filename="libunitreeDrawForcePlugin.so"><topicName>toe</topicName></plugin></visual>
<sensor name="toe" type="contact"><update_rate>100</update_rate><contact><collision>c</collision></contact>
<plugin name="feel" filename="libunitreeFootContactPlugin.so"/></sensor></link></model></sdf>"""


def test_the_line_of_the_force_starts_at_the_foot(bare_gazebo: Gazebo) -> None:
    """2 kg weigh 19.6 N: 19.6 N / (20 N/m) · 0.2 = 0.196 m."""
    ground = "<include><uri>model://ground_plane</uri></include>"
    bare_gazebo.start(world=f'<sdf version="1.6"><world name="w">{ground}</world></sdf>')
    assert bare_gazebo.spawn(_FOOT, "foot").success
    simulation = bare_gazebo.world.simulation
    (line,) = simulation.lines.values()
    bare_gazebo.call("unpause_physics")
    bare_gazebo.until_s(0.2)
    assert line.points == []  # no viewer shows lines

    simulation.post(lambda simulation: setattr(simulation, "lines_are_shown", True))
    until(lambda: line.points and line.points[1][2] > 0.25)
    bare_gazebo.until_s(bare_gazebo.time_s + 1.0)
    bare_gazebo.call("pause_physics")
    (drawn,) = plugin_lines(simulation)
    assert drawn.points.tolist() == [pytest.approx([0.0, 0.0, z], abs=2e-3) for z in (0.1, 0.296)]

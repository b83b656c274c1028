"""A quadrotor of RotorS' plugins in the namespace `quad`; its rotors stand crosswise."""

import math

_INERTIA = "<inertia><ixx>{0}</ixx><iyy>{0}</iyy><izz>{1}</izz></inertia>"
_BODY, ROTOR = 0.7, 0.005
LIFT, MOMENT = 8.5e-6, 0.016
G = 9.8
HOVER = math.sqrt((_BODY + 4 * ROTOR) * G / 4 / LIFT)
"""[rad/s] At which four rotors carry it."""
PLUGIN = '<plugin name="{0}" filename="librotors_gazebo_{0}.so"><robotNamespace>quad</robotNamespace>{1}</plugin>'


def _rotor(number: int, x: float, y: float, way: str, more: str = "") -> str:
    parameters = f"""<jointName>rotor_{number}_joint</jointName><linkName>rotor_{number}</linkName>
<turningDirection>{way}</turningDirection><motorNumber>{number}</motorNumber><motorConstant>{LIFT}</motorConstant>
<momentConstant>{MOMENT}</momentConstant><commandSubTopic>gazebo/command/motor_speed</commandSubTopic>
<motorSpeedPubTopic>motor_speed/{number}</motorSpeedPubTopic>{more}"""
    plugin = PLUGIN.format("motor_model", parameters).replace('name="motor_model"', f'name="motor_{number}"')
    return f"""<link name="rotor_{number}"><pose>{x} {y} 0.05 0 0 0</pose><inertial><mass>{ROTOR}</mass>
{_INERTIA.format(1e-5, 2e-5)}</inertial></link><joint name="rotor_{number}_joint" type="revolute">
<parent>base_link</parent><child>rotor_{number}</child><axis><xyz>0 0 1</xyz></axis></joint>{plugin}"""


def quadrotor(more: str = "", motor: str = "") -> str:
    """Content of a <model> that hovers at 1 m.

    Args:
        more: further elements.
        motor: further parameters of each motor.
    """
    places = ((0.2, 0.0, "ccw"), (0.0, 0.2, "cw"), (-0.2, 0.0, "ccw"), (0.0, -0.2, "cw"))
    rotors = "".join(_rotor(number, *place, motor) for number, place in enumerate(places))
    inertial = f"<inertial><mass>{_BODY}</mass>{_INERTIA.format(0.007, 0.012)}</inertial>"
    return f'<pose>0 0 1 0 0 0</pose><link name="base_link">{inertial}</link>{rotors}{more}'

"""A quadrotor with RotorS' plugins in the namespace `quad`; its rotors are on the x and y axes."""

import math

_INERTIA = "<inertia><ixx>{0}</ixx><iyy>{0}</iyy><izz>{1}</izz></inertia>"
_BODY_MASS, ROTOR_MASS = 0.7, 0.005
LIFT, MOMENT = 8.5e-6, 0.016
G = 9.8
HOVER = math.sqrt((_BODY_MASS + 4 * ROTOR_MASS) * G / 4 / LIFT)
"""Rotor speed in hover [rad/s]."""
PLUGIN = '<plugin name="{0}" filename="librotors_gazebo_{0}.so"><robotNamespace>quad</robotNamespace>{1}</plugin>'


def _rotor(number: int, x: float, y: float, direction: str, more: str = "") -> str:
    parameters = f"""<jointName>rotor_{number}_joint</jointName><linkName>rotor_{number}</linkName>
<turningDirection>{direction}</turningDirection><motorNumber>{number}</motorNumber><motorConstant>{LIFT}</motorConstant>
<momentConstant>{MOMENT}</momentConstant><commandSubTopic>gazebo/command/motor_speed</commandSubTopic>
<motorSpeedPubTopic>motor_speed/{number}</motorSpeedPubTopic>{more}"""
    plugin = PLUGIN.format("motor_model", parameters).replace('name="motor_model"', f'name="motor_{number}"')
    return f"""<link name="rotor_{number}"><pose>{x} {y} 0.05 0 0 0</pose><inertial><mass>{ROTOR_MASS}</mass>
{_INERTIA.format(1e-5, 2e-5)}</inertial></link><joint name="rotor_{number}_joint" type="revolute">
<parent>base_link</parent><child>rotor_{number}</child><axis><xyz>0 0 1</xyz></axis></joint>{plugin}"""


def quadrotor(more: str = "", motor: str = "") -> str:
    """Return the content of a <model> at 1 m height.

    Args:
        more: further elements.
        motor: further parameters of each motor.
    """
    rotors_xy = ((0.2, 0.0, "ccw"), (0.0, 0.2, "cw"), (-0.2, 0.0, "ccw"), (0.0, -0.2, "cw"))
    rotors = "".join(_rotor(number, *rotor_xy, motor) for number, rotor_xy in enumerate(rotors_xy))
    inertial = f"<inertial><mass>{_BODY_MASS}</mass>{_INERTIA.format(0.007, 0.012)}</inertial>"
    return f'<pose>0 0 1 0 0 0</pose><link name="base_link">{inertial}</link>{rotors}{more}'

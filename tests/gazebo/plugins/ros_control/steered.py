"""Robots with steered wheels that ros_control drives, on the ground."""

import math

RADIUS = 0.1


def inertial(mass: float, moment: float, *, com: str = "0 0 0") -> str:
    moments = " ".join(f'{name}="{moment}"' for name in ("ixx", "iyy", "izz"))
    return (
        f'<inertial><origin xyz="{com}"/><mass value="{mass}"/><inertia {moments} ixy="0" ixz="0" iyz="0"/></inertial>'
    )


def _driven(joint: str, interface: str) -> str:
    return f"""<transmission name="{joint}_t"><type>transmission_interface/SimpleTransmission</type>
<joint name="{joint}"><hardwareInterface>hardware_interface/{interface}</hardwareInterface></joint>
<actuator name="{joint}_m"/></transmission>"""


def wheel(name: str, parent: str, x: float, y: float, *, driven: bool = True) -> str:
    """Return a wheel with the axis y, and its joint `<name>_joint`."""
    transmission = _driven(f"{name}_joint", "VelocityJointInterface") if driven else ""
    cylinder = f'<geometry><cylinder radius="{RADIUS}" length="0.03"/></geometry>'
    return f"""<link name="{name}">{inertial(0.5, 0.002)}
<collision><origin rpy="{math.pi / 2} 0 0"/>{cylinder}</collision></link>
<joint name="{name}_joint" type="continuous"><parent link="{parent}"/><child link="{name}"/>
<origin xyz="{x} {y} 0"/><axis xyz="0 1 0"/></joint>{transmission}"""


def knuckle(name: str, x: float, y: float) -> str:
    """Return the steering knuckle of a wheel, with its joint `<name>_joint`."""
    return f"""<link name="{name}">{inertial(0.2, 0.002)}</link>
<joint name="{name}_joint" type="revolute"><parent link="base_link"/><child link="{name}"/><origin xyz="{x} {y} 0"/>
<axis xyz="0 0 1"/><limit lower="-1.5" upper="1.5" effort="100" velocity="10"/></joint>
{_driven(f"{name}_joint", "PositionJointInterface")}"""


def robot(parts: str, *, com: str = "0 0 0", skids: str = "") -> str:
    """Return a base with the given parts and centre of mass, under ros_control in the root namespace.

    Args:
        parts: links and joints, as URDF.
        com: centre of mass in the base's frame [m].
        skids: collisions of the base, without friction.
    """
    return f"""<robot name="car"><link name="base_link">{inertial(5, 0.2, com=com)}{skids}</link>{parts}
<gazebo reference="base_link"><mu1>0</mu1><mu2>0</mu2></gazebo>
<gazebo><plugin name="control" filename="libgazebo_ros_control.so"><robotNamespace>/</robotNamespace></plugin></gazebo>
</robot>"""

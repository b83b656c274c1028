"""Multirotors with published parameters, against their equations of motion."""

from pathlib import Path

import numpy as np
import pytest
from msgspec import Struct
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from tests.gazebo.plugins.plugin_world import FakeNode, load
from tests.gazebo.plugins.rotors.quadrotor import PLUGIN, G

_Array = NDArray[np.float64]
INTERVAL_S, INTERVALS = 0.25, 6
UP_S, DOWN_S, SLOWDOWN, ROLL = 0.0125, 0.025, 10.0, 1e-6


class Multirotor(Struct, frozen=True):
    """Parameters of a vehicle in rotors_description (ethz-asl/rotors_simulator)."""

    mass: float
    """[kg], without rotors."""
    inertia: tuple[float, float, float]
    rotor_mass: float
    arms: tuple[tuple[float, float], ...]
    """Rotors' positions: distance [m] and angle [rad]; directions alternate, the first is counter-clockwise."""
    height: float
    lift: float
    moment: float
    drag: float
    blade: tuple[float, float]
    """Length and width of a rotor's blades [m]."""


def _arms(length: float, count: int, first: float) -> tuple[tuple[float, float], ...]:
    return tuple((length, first + 2 * np.pi * i / count) for i in range(count))


VEHICLES = {
    "hummingbird": Multirotor(
        0.68, (0.007, 0.007, 0.012), 0.009, _arms(0.17, 4, 0.0), 0.01, 8.54858e-6, 0.016, 8.06428e-5, (0.1, 0.02)
    ),
    "firefly": Multirotor(
        1.5,
        (0.0347563, 0.0458929, 0.0977),
        0.005,
        _arms(0.215, 6, np.pi / 6),
        0.037,
        8.54858e-6,
        0.016,
        8.06428e-5,
        (0.2, 0.03),
    ),
    "pelican": Multirotor(
        1.0, (0.01, 0.01, 0.02), 0.005, _arms(0.21, 4, 0.0), 0.02, 9.9865e-6, 0.016, 8.06428e-5, (0.2, 0.03)
    ),
}


def _rotor_inertia(vehicle: Multirotor) -> _Array:
    length, width = vehicle.blade
    return vehicle.rotor_mass / 12 * np.array([length**2 + width**2] * 2 + [length**2 + width**2])


def _sdf(vehicle: Multirotor) -> str:
    def inertial(mass: float, moments: _Array) -> str:
        tags = "".join(f"<i{axis}>{value}</i{axis}>" for axis, value in zip(("xx", "yy", "zz"), moments, strict=True))
        return f"<inertial><mass>{mass}</mass><inertia>{tags}</inertia></inertial>"

    text = f'<link name="base_link">{inertial(vehicle.mass, np.array(vehicle.inertia))}</link>'
    for i, (length, angle) in enumerate(vehicle.arms):
        pose = f"{length * np.cos(angle)} {length * np.sin(angle)} {vehicle.height} 0 0 0"
        rotor = inertial(vehicle.rotor_mass, _rotor_inertia(vehicle))
        text += f"""<link name="r{i}"><pose>{pose}</pose>{rotor}</link><joint name="j{i}" type="revolute">
        <parent>base_link</parent><child>r{i}</child><axis><xyz>0 0 1</xyz></axis></joint>"""
        parameters = f"""<jointName>j{i}</jointName><linkName>r{i}</linkName><motorNumber>{i}</motorNumber>
        <turningDirection>{"cw" if i % 2 else "ccw"}</turningDirection><timeConstantUp>{UP_S}</timeConstantUp>
        <timeConstantDown>{DOWN_S}</timeConstantDown><maxRotVelocity>838</maxRotVelocity>
        <motorConstant>{vehicle.lift}</motorConstant><momentConstant>{vehicle.moment}</momentConstant>
        <rotorDragCoefficient>{vehicle.drag}</rotorDragCoefficient><rollingMomentCoefficient>{ROLL}
        </rollingMomentCoefficient><rotorVelocitySlowdownSim>{SLOWDOWN}</rotorVelocitySlowdownSim>"""
        text += PLUGIN.format("motor_model", parameters).replace('name="motor_model"', f'name="m{i}"')
    return text


def _true_motion(vehicle: Multirotor, commands: _Array) -> _Array:
    """Return the true position, quaternion xyzw, velocity and angular velocity of the body."""
    count = len(vehicle.arms)
    directions = np.array([-1.0 if i % 2 else 1.0 for i in range(count)])
    positions = np.array([(r * np.cos(a), r * np.sin(a), vehicle.height) for r, a in vehicle.arms])
    spin = _rotor_inertia(vehicle)
    mass = vehicle.mass + count * vehicle.rotor_mass
    com = vehicle.rotor_mass * positions.sum(axis=0) / mass
    inertia = np.diag(np.array(vehicle.inertia)) + vehicle.mass * _parallel(-com)
    inertia += sum(np.diag(spin) + vehicle.rotor_mass * _parallel(position - com) for position in positions)
    axis = np.array((0.0, 0.0, 1.0))

    def motion(_time: float, state: _Array, command: _Array) -> _Array:
        rotation = Rotation.from_quat(state[3:7])
        velocity, rate, speeds = rotation.inv().apply(state[7:10]), state[10:13], state[13:]
        acceleration = (command - speeds) / np.where(command > speeds, UP_S, DOWN_S)
        force, torque = np.zeros(3), np.zeros(3)
        for position, direction, speed in zip(positions - com, directions, speeds, strict=True):
            radial_velocity = velocity + np.cross(rate, position)
            radial_velocity[2] = 0.0
            thrust = vehicle.lift * speed**2
            rotor_force = thrust * axis - speed * vehicle.drag * radial_velocity
            force += rotor_force
            torque += (
                np.cross(position, rotor_force)
                - direction * thrust * vehicle.moment * axis
                - speed * ROLL * radial_velocity
            )
        momentum = inertia @ rate + spin[2] * (directions * speeds).sum() / SLOWDOWN * axis
        torque -= spin[2] * (directions * acceleration).sum() / SLOWDOWN * axis
        x, y, z = rate
        w = state[6]
        quaternion_rate = 0.5 * np.array(
            [
                w * x + state[4] * z - state[5] * y,
                w * y + state[5] * x - state[3] * z,
                w * z + state[3] * y - state[4] * x,
                -state[3:6] @ rate,
            ]
        )
        linear = rotation.apply(force) / mass - G * axis
        angular = np.linalg.solve(inertia, torque - np.cross(rate, momentum))
        return np.concatenate([state[7:10], quaternion_rate, linear, angular, acceleration])

    state = np.concatenate([com, (0, 0, 0, 1), np.zeros(6 + count)])
    for command in commands:
        state = solve_ivp(motion, (0, INTERVAL_S), state, args=(command,), method="DOP853", rtol=1e-9, atol=1e-10).y[
            :, -1
        ]
    state[:3] -= Rotation.from_quat(state[3:7]).apply(com)
    return state


def _parallel(offset: _Array) -> _Array:
    return float(offset @ offset) * np.eye(3) - np.outer(offset, offset)


@pytest.mark.parametrize("name", VEHICLES)
@pytest.mark.parametrize("seed", range(3))
def test_a_multirotor_follows_its_equations_of_motion(tmp_path: Path, name: str, seed: int) -> None:
    """For 1.5 s, each rotor with a new random speed around hover every 0.25 s.

    The firefly's moments of inertia violate the triangle inequality; raised to fit, they turn it 0.15 rad less.
    """
    vehicle = VEHICLES[name]
    count = len(vehicle.arms)
    hover = np.sqrt((vehicle.mass + count * vehicle.rotor_mass) * G / count / vehicle.lift)
    commands = hover * np.random.default_rng(seed).uniform(0.97, 1.05, (INTERVALS, count))
    node = FakeNode()
    sim = load(tmp_path, _sdf(vehicle), gravity=f"0 0 -{G}", node=node)
    for command in commands:
        node.receive("/quad/command/motor_speed", angular_velocities=command.tolist())
        sim.run(INTERVAL_S)

    link = sim["m"].link("base_link")
    truth = _true_motion(vehicle, commands)
    w, x, y, z = link.pose.quaternion
    angle_error = (Rotation.from_quat((x, y, z, w)).inv() * Rotation.from_quat(truth[3:7])).magnitude()
    assert link.pose.position == pytest.approx(truth[:3], abs=0.01)
    assert angle_error < 0.01

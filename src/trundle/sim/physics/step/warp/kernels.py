"""Joint motors and stops on a GPU, as in `cpp/contact/velocity_motor.cc` and `cpp/contact/joint_stop.cc`.

Warp compiles these functions when they first run.
"""

import mujoco
import warp as wp

_TENDON = wp.constant(int(mujoco.mjtConstraint.mjCNSTR_FRICTION_TENDON))
_LIMIT = wp.constant(int(mujoco.mjtConstraint.mjCNSTR_LIMIT_JOINT))
_BEYOND = wp.constant(1e-7)
"""Distance [rad or m] past a limit at which a joint is stopped, so that MuJoCo's constraint holds it from then on."""


@wp.kernel(enable_backward=False)
def drive(
    h: float,
    motors: wp.array2d[int],
    stops: wp.array2d[float],
    rates: wp.array2d[float],
    ctrl: wp.array2d[float],
    qpos: wp.array2d[float],
    nefc: wp.array[int],
    kinds: wp.array2d[int],
    ids: wp.array2d[int],
    positions: wp.array2d[float],
    margins: wp.array2d[float],
    speeds: wp.array2d[float],
    references: wp.array2d[float],
):
    """Set the reference accelerations of the constraint rows of motors and of joints near a stop.

    Args:
        h: time step [s].
        motors: (tendons, 2) actuator, and address in qpos.
        stops: (joints, 2) stiffness and damping of the limit's row.
        rates: (worlds, tendons) position gain [1/s]; 0: speed motor.
        ctrl: (worlds, actuators) target speeds or positions.
        qpos: (worlds, …)
        nefc: (worlds,) number of rows.
        kinds: (worlds, rows) type of the constraint.
        ids: (worlds, rows) tendon or joint of the row.
        positions: (worlds, rows) distance from the limit.
        margins: (worlds, rows) distance up to which a row exists.
        speeds: (worlds, rows) velocity of the constraint.
        references: (worlds, rows) reference accelerations.
    """
    world, row = wp.tid()
    if row >= nefc[world]:
        return
    at = ids[world, row]
    if kinds[world, row] == _TENDON:
        target = ctrl[world, motors[at, 0]]
        if rates[world, at] > 0.0:
            target = rates[world, at] * (target - qpos[world, motors[at, 1]])
        references[world, row] = (target - speeds[world, row]) / h
    elif kinds[world, row] == _LIMIT and margins[world, row] > 0.0:
        distance = positions[world, row]
        if distance < 0.0:
            k, b = stops[at, 0], stops[at, 1]
            references[world, row] = -(k * distance + (b + h * k) * speeds[world, row]) / (1.0 + h * b + h * h * k)
        else:
            references[world, row] = -((distance + _BEYOND) / h + speeds[world, row]) / h

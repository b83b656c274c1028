"""Solver settings tuned to analytic results and Gazebo; h is the time step.

Found by measurement on a pendulum, inclines, rolling, drops and limits: the pendulum's period is right to 4e-5 %, a
block on an incline just below slipping creeps 3e-4 mm/s (Gazebo: 5 mm/s), a dropped box does not bounce.
"""

import mujoco

CONTACT_DAMPING_RATIO = 2.8
"""Damping ratio of hard contacts. With 1 a box bounces 25 to 35 mm after a drop of 1 m; with 2 it does not, but 19 mm
after an impact at 10 m/s; with 2.8 it does not bounce even then: it rises so slowly that gravity stops it.
"""
_MANY = 6
"""Number of trees from which on the Jacobian is sparse."""
SOLIMP = (0.99, 0.99, 0.001, 0.5, 2.0)


def contact_solref(h: float) -> tuple[float, float]:
    """Return time constant [s] and damping ratio of hard contacts, at a time step of h [s]."""
    return (2 * h, CONTACT_DAMPING_RATIO)


def limit_solref(h: float) -> tuple[float, float]:
    """Return the solref of joint limits: a joint stops within one step, and returns to the limit over two hundred,
    without a bounce.
    """
    return (-1 / (h * h), -200 / h)


def friction_solref(h: float) -> tuple[float, float]:
    """Return the solref of joint friction."""
    return (2 * h, 1.0)


def equality_solref(h: float) -> tuple[float, float]:
    """Return the solref of mimic, gear and loop constraints, as stiff as a step can follow: a four-bar crank lags 4
    mrad after 3 s; with (2 h, 1) it would lag 0.13 rad.
    """
    return (-1 / (h * h), -1 / h)


def sliding_solref(h: float) -> tuple[float, float]:
    """Return the solref of contact friction: a body sliding at 1 m/s hops less than 0.4 mm; stiffer, 8 mm."""
    return (10 * h, 1.0)


def apply_settings(spec: mujoco.MjSpec) -> None:
    """Set the solver options other than time step and gravity."""
    option = spec.option
    option.integrator = mujoco.mjtIntegrator.mjINT_DISCRETE
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    option.impratio = 100
    option.solver = mujoco.mjtSolver.mjSOL_NEWTON
    option.tolerance = 1e-8
    option.iterations = 100
    # [m] With MuJoCo's default 1e-6 a round wheel on a box carries half its load or none next to other contacts, and
    # shallower contacts may be pushed the wrong way.
    option.ccd_tolerance = 1e-9
    option.ccd_iterations = 100
    # Islands cost an awake robot a tenth of its speed, for nothing while nothing sleeps.
    option.disableflags |= mujoco.mjtDisableBit.mjDSBL_ISLAND
    option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    spec.compiler.degree = False
    spec.compiler.autolimits = False
    spec.compiler.fusestatic = False
    spec.compiler.discardvisual = False
    spec.compiler.inertiafromgeom = mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_FALSE


def choose_jacobian(model: mujoco.MjModel) -> None:
    """Use sparse constraint Jacobians in worlds of many trees; MuJoCo itself does from 60 degrees of freedom on.

    Boxes at rest side by side: 2 cost 14 % more, 5 3 % less, 9 21 % less.
    """
    if model.ntree >= _MANY:
        model.opt.jacobian = mujoco.mjtJacobian.mjJAC_SPARSE


def silence_log() -> None:
    """Keep MuJoCo from writing MUJOCO_LOG.TXT to the working directory; the engine reads its warnings."""
    config = mujoco.MjLogConfig.get()
    config.logto_file = config.logto_console = False
    config.set()

"""Solver settings that meet Gazebo and the textbook; h is the time step.

Found by measurement on a pendulum, inclines, rolling, drops and limits: with them the pendulum's period is right to
4e-5 %, a block on an incline just below slipping creeps 3e-4 mm/s (Gazebo: 5 mm/s), a dropped box does not bounce.
"""

import mujoco

CONTACT_DAMPING_RATIO = 2.8
"""1 lets a box bounce 25 to 35 mm after a drop of 1 m. 2 does not, but 19 mm when it comes at 10 m/s; 2.8 not even
then, for it comes up so slowly that gravity stops it.
"""
_MANY = 6
"""Trees of bodies from which on each meets few of the others."""
SOLIMP = (0.99, 0.99, 0.001, 0.5, 2.0)


def contact_solref(h: float) -> tuple[float, float]:
    """Time constant [s] and damping ratio of hard contacts, at a time step of h [s]."""
    return (2 * h, CONTACT_DAMPING_RATIO)


def limit_solref(h: float) -> tuple[float, float]:
    """Solver parameters of joint limits: stopped within a step, and back at the limit over two hundred: no bounce."""
    return (-1 / (h * h), -200 / h)


def friction_solref(h: float) -> tuple[float, float]:
    """Of joint friction."""
    return (2 * h, 1.0)


def equality_solref(h: float) -> tuple[float, float]:
    """Of what holds two joints or the two halves of a link together: as stiff as a step can follow, so that a loop of
    links keeps its course; by (2 h, 1) a crank of four bars is 0.13 rad behind after 3 s, so 4 mrad."""
    return (-1 / (h * h), -1 / h)


def sliding_solref(h: float) -> tuple[float, float]:
    """Of contact friction: stiffer, a body sliding at 1 m/s hops 8 mm; so, less than 0.4 mm."""
    return (10 * h, 1.0)


def apply_settings(spec: mujoco.MjSpec) -> None:
    """Set the solver; time step and gravity are the world's."""
    option = spec.option
    option.integrator = mujoco.mjtIntegrator.mjINT_DISCRETE
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    option.impratio = 100
    option.solver = mujoco.mjtSolver.mjSOL_NEWTON
    option.tolerance = 1e-8
    option.iterations = 100
    # [m] By MuJoCo's own 1e-6 a round wheel on a box bears half as much or nothing of what it should, where others bear
    # with it, and what is less deep than that may be pushed the wrong way.
    option.ccd_tolerance = 1e-9
    option.ccd_iterations = 100
    # Islands cost an awake robot a tenth of its speed and bring nothing while nothing sleeps.
    option.disableflags |= mujoco.mjtDisableBit.mjDSBL_ISLAND
    option.disableflags |= mujoco.mjtDisableBit.mjDSBL_AUTORESET
    spec.compiler.degree = False
    spec.compiler.autolimits = False
    spec.compiler.fusestatic = False
    spec.compiler.discardvisual = False
    spec.compiler.inertiafromgeom = mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_FALSE


def choose_jacobian(model: mujoco.MjModel) -> None:
    """Have MuJoCo write constraints sparsely where many things move; by itself it does from 60 freedoms on.

    Boxes that rest side by side: 2 cost 14 % more so, 5 3 % less, 9 21 % less.
    """
    if model.ntree >= _MANY:
        model.opt.jacobian = mujoco.mjtJacobian.mjJAC_SPARSE


def silence_log() -> None:
    """Keep MuJoCo from writing MUJOCO_LOG.TXT where the user stands; the engine reads its warnings."""
    config = mujoco.MjLogConfig.get()
    config.logto_file = config.logto_console = False
    config.set()

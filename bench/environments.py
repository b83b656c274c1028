"""A vector environment of 256 differential robots with goal and lidar observations, against MuJoCo's batch stepping.

The peer is `mujoco.rollout` of the same model from the same states with the same motors and number of threads, without
observations and rewards. Times are of this process' CPU, which depends least on other programs.
"""

import copy
import os
import statistics
import time

import mujoco
import numpy as np
from mujoco.rollout import Rollout

from bench.table import Row
from trundle.gym import make_vec
from trundle.gym.ready_tasks import READY
from trundle.gym.vector_env import SimulationVectorEnv

_WORLDS = 256
_STEPS = 12
"""Steps of the environment, each followed by one of the peer; episodes last about 20 to 40 steps."""
_STATE = mujoco.mjtState.mjSTATE_INTEGRATION
_PHYSICS = mujoco.mjtState.mjSTATE_FULLPHYSICS
_CONTROL = mujoco.mjtState.mjSTATE_CTRL


def run() -> list[Row]:
    """Alternate environment and peer, so that a varying machine speed affects both equally."""
    file, task = READY["Trundle/DriveToGoal-v0"]
    threads = os.cpu_count() or 1
    envs = make_vec(file, num_envs=_WORLDS, threads=threads, **task)
    envs.reset(seed=0)
    envs.action_space.seed(0)
    steps = _WORLDS * envs.worlds.steps
    pairs: list[tuple[float, float]] = []
    with Rollout(nthread=threads) as rollout:
        for _ in range(_STEPS):
            actions, states = envs.action_space.sample(), envs.worlds.states.batch.states.copy()
            start = time.process_time()
            envs.step(actions)
            envs_s = time.process_time() - start
            pairs.append((steps / envs_s, steps / _rollout_s(envs, states, rollout, threads)))
    rate = statistics.median(envs_rate for envs_rate, _ in pairs)
    ratio = statistics.median(envs_rate / peer_rate for envs_rate, peer_rate in pairs)
    return [Row(f"vector environment of {_WORLDS} differential robots", rate, "steps/s", "mujoco.rollout", ratio)]


def _rollout_s(envs: SimulationVectorEnv, before: np.ndarray, rollout: Rollout, threads: int) -> float:
    """Return the CPU time [s] of a rollout of all worlds' last period."""
    worlds = envs.worlds
    model = copy.copy(worlds.states.simulation.engine.compiled.model)
    wheels = worlds.states.axes("left_joint", "right_joint")
    model.tendon_frictionloss[worlds.states.simulation.engine.compiled.axis_actuator[list(wheels)]] = 5.0
    model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_ACTUATION)
    states, controls = _part(model, before, _PHYSICS), _part(model, worlds.states.batch.states, _CONTROL)
    controls = np.repeat(controls[:, None], worlds.steps, axis=1)
    datas = [mujoco.MjData(model) for _ in range(threads)]
    start = time.process_time()
    rollout.rollout(model, datas, states, controls)
    return time.process_time() - start


def _part(model: mujoco.MjModel, states: np.ndarray, part: mujoco.mjtState) -> np.ndarray:
    """Return (rows, …) one part of states."""
    parts = np.empty((len(states), mujoco.mj_stateSize(model, int(part))))
    for state, target in zip(states, parts, strict=True):
        mujoco.mj_extractState(model, state, int(_STATE), target, int(part))
    return parts

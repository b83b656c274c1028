"""Environments from descriptions: observations, actions, limits and errors."""

import subprocess
import sys
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from numpy.typing import NDArray

import trundle
from trundle import gym
from trundle.base.diagnostics import UsageError
from trundle.gym.worlds import Observed
from trundle.live.loaded_simulation import LoadedSimulation
from trundle.spatial import Pose

URDF = """
<robot name="cart">
  <link name="base">
    <inertial><mass value="2"/><inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><box size="0.3 0.2 0.1"/></geometry></collision>
    <visual><geometry><box size="0.3 0.2 0.1"/></geometry></visual>
  </link>
  <link name="arm">
    <inertial><origin xyz="0 0 0.2"/><mass value="0.5"/>
      <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <joint name="hinge" type="revolute">
    <origin xyz="0 0 0.05"/><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
    <limit lower="-1.5" upper="0.5" effort="5" velocity="3"/>
  </joint>
  <gazebo reference="base">
    <sensor name="eye" type="camera">
      <camera><image><width>32</width><height>24</height></image><clip><near>0.05</near><far>50</far></clip></camera>
    </sensor>
    <sensor name="laser" type="ray">
      <pose>0 0 0.1 0 0.3 0</pose>
      <ray><scan><horizontal><samples>5</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan>
      <range><min>0.1</min><max>4</max></range><noise><type>gaussian</type><stddev>0.02</stddev></noise></ray>
    </sensor>
  </gazebo>
</robot>
"""
HINGE: Any = {"observations": gym.JointPositions("hinge"), "actions": gym.PositionAction("hinge")}


@pytest.fixture(scope="module")
def cart(tmp_path_factory: pytest.TempPathFactory) -> str:
    file = tmp_path_factory.mktemp("gym") / "cart.urdf"
    file.write_text(URDF)
    return str(file)


def _array(observation: Observed) -> NDArray[Any]:
    assert isinstance(observation, np.ndarray)
    return observation


def _zero_reward(states: gym.WorldStates) -> NDArray[np.float64]:
    return np.zeros(states.rows)


def _number_of_rows(states: gym.WorldStates) -> Any:
    return float(states.rows)


# Actions are in the units of the description; Gymnasium's RescaleAction normalizes them.
@pytest.mark.filterwarnings("ignore:.*we recommend using a symmetric and normalized space")
@pytest.mark.filterwarnings("ignore:.*Box observation space (minimum|maximum) value is.*infinity")
@pytest.mark.filterwarnings("ignore:.*has an unconventional shape")
def test_observations_by_name(cart: str) -> None:
    env: Any = gym.make(
        cart,
        observations={
            "q": gym.JointPositions("hinge"),
            "v": gym.JointVelocities("cart::hinge"),
            "pose": gym.LinkPose("base"),
            "twist": gym.LinkTwist("arm"),
            "tip": gym.LinkPosition("arm", relative_to="base"),
            "scan": gym.LidarRanges("laser"),
            "eye": gym.CameraPicture("eye"),
            "time": gym.Computed(lambda states: states.time_s[:, None], low=[0.0], high=[9.0]),
        },
        actions=[gym.EffortAction("hinge")],
        reward=_zero_reward,
        max_steps=50,
        period_s=0.01,
        render_mode="rgb_array",
        camera="eye",
    )

    check_env(env, skip_render_check=True, skip_close_check=True)
    env.reset(seed=1)
    observation = env.step(np.array([5.0], dtype=np.float32))[0]

    assert (env.observation_space["q"].low, env.observation_space["q"].high) == (-1.5, 0.5)
    assert (env.action_space.low, env.action_space.high) == (-5.0, 5.0)
    assert observation["v"] > 0.1
    assert observation["tip"] == pytest.approx([0.0, 0.0, 0.05], abs=1e-6)
    assert observation["scan"].shape == (5,)
    assert 0.1 < observation["scan"].min() < 1.0
    assert observation["time"] == pytest.approx(0.01)
    assert (env.render() == observation["eye"]).all()


def test_the_environment_equals_the_python_api(cart: str) -> None:
    env = gym.make(cart, reward=_zero_reward, **HINGE)
    sim = trundle.load(cart)
    hinge = sim["cart"].joint("hinge")
    env.reset()
    for target in (0.4, -1.0, 0.2):
        env.step(np.array([target], dtype=np.float32))
        hinge.command_position(float(np.float32(target)))
        sim.run(0.02)

    assert env.worlds.states.joint_positions("hinge")[0].tolist() == sim["cart"].joint_positions.tolist()
    assert env.worlds.states.link_poses("base")[0].tolist() == sim.engine.reader.link_poses()[0].tolist()


def test_a_reset_restores_the_loaded_state_and_calls_the_tasks_reset(cart: str) -> None:
    def tilt(simulation: LoadedSimulation, random: np.random.Generator) -> None:
        simulation["cart"].joint("hinge").set_position(random.uniform(-1.0, 0.0))

    env = gym.make(cart, reward=_zero_reward, reset=tilt, max_steps=3, **HINGE)
    compiled = env.worlds.states.simulation.engine.compiled
    first = _array(env.reset(seed=3)[0]).tobytes()
    second = _array(env.reset()[0]).tobytes()
    truncated = [env.step(env.action_space.sample())[3] for _ in range(3)]

    assert first != second
    assert truncated == [False, False, True]
    assert _array(env.reset(seed=3)[0]).tobytes() == first
    assert env.worlds.states.simulation.engine.compiled is compiled


def test_unstable_physics_ends_only_the_episode_of_its_world(cart: str) -> None:
    envs = gym.make_vec(cart, num_envs=2, reward=_zero_reward, **HINGE)
    envs.reset(seed=0)
    envs.worlds.states.batch.states[1, 9] = 1e9

    _, _, terminated, _, infos = envs.step(np.zeros((2, 1), dtype=np.float32))

    assert terminated.tolist() == [False, True]
    assert infos["unstable"].tolist() == [False, True]
    assert np.isfinite(_array(envs.step(np.zeros((2, 1), dtype=np.float32))[0])).all()


def test_a_world_built_in_code(cart: str) -> None:
    world = trundle.World("yard")
    world.add_ground_plane()
    world.add_sphere("ball", 0.1, mass=0.5)
    cart_model = world.add_model("slider")
    bar = cart_model.add_box("bar", (0.1, 0.1, 0.1), mass=1.0, pose=Pose((0.0, 0.0, 1.0)))
    cart_model.add_joint("rail", "prismatic", "world", bar, axis=(1.0, 0.0, 0.0))
    env = gym.make(
        world,
        observations=[gym.JointPositions("rail"), gym.LinkPosition("ball::link")],
        actions=gym.VelocityAction("rail", max_velocity=1.0, max_effort=50.0),
        reward=_zero_reward,
    )

    observation, _ = env.reset(seed=0)
    for _ in range(10):
        observation = env.step(np.array([1.0], dtype=np.float32))[0]

    assert _array(observation)[0] == pytest.approx(0.2, abs=0.02)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"observations": gym.JointPositions("knee")}, "no joint 'knee'; there are: 'cart::hinge'"),
        ({"observations": gym.LinkPose("hand")}, "no link 'hand'; there are: 'cart::base'"),
        ({"observations": gym.LidarRanges("radar")}, "no lidar 'radar'; there are: 'cart::base::laser'"),
        ({"observations": [gym.CameraPicture("eye"), gym.LinkPose("arm")]}, "name them"),
        ({"actions": gym.TwistAction("cart", max_forward=1.0, max_yaw_rate=1.0)}, "has no plugin"),
        ({"period_s": 0.0015}, "not a multiple"),
        ({"render_mode": "human"}, "rgb_array"),
    ],
)
def test_invalid_arguments_are_errors(cart: str, arguments: dict[str, Any], message: str) -> None:
    task: Any = {"reward": _zero_reward, **HINGE, **arguments}
    with pytest.raises(UsageError, match=message):
        gym.make(cart, **task)


def test_an_invalid_action_or_reward_is_an_error(cart: str) -> None:
    env = gym.make(cart, reward=_zero_reward, **HINGE)
    env.reset()
    with pytest.raises(UsageError, match=r"shape \(1, 2\), not \(1, 1\)"):
        env.step(np.zeros(2, dtype=np.float32))
    with pytest.raises(UsageError, match="not finite"):
        env.step(np.array([np.nan], dtype=np.float32))
    scalar = gym.make(cart, reward=_number_of_rows, **HINGE)
    scalar.reset()
    with pytest.raises(UsageError, match="a value for each world"):
        scalar.step(np.zeros(1, dtype=np.float32))


def test_the_error_without_gymnasium_names_the_extra() -> None:
    code = "import sys; sys.modules['gymnasium'] = None\nimport trundle.gym"
    process = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)

    assert "trundle.gym needs the package 'gymnasium': pip install 'trundle[gym]'" in process.stderr


def test_the_built_in_environments_are_registered() -> None:
    assert {name for name in gymnasium.registry if name.startswith("Trundle/")} == {
        "Trundle/ArmReach-v0",
        "Trundle/CartPole-v0",
        "Trundle/DriveToGoal-v0",
    }

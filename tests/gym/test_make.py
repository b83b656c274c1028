"""Environments from descriptions: every kind of observation and action, limits, and what cannot be done."""

import subprocess
import sys

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import trundle
from trundle import gym
from trundle.base.diagnostics import UsageError
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
HINGE = {"observations": gym.JointPositions("hinge"), "actions": gym.PositionAction("hinge")}


@pytest.fixture(scope="module")
def cart(tmp_path_factory) -> str:
    file = tmp_path_factory.mktemp("gym") / "cart.urdf"
    file.write_text(URDF)
    return str(file)


def _nothing(states: gym.WorldStates) -> np.ndarray:
    return np.zeros(states.rows)


# Actions are in the units of the description; Gymnasium's RescaleAction normalizes them.
@pytest.mark.filterwarnings("ignore:.*we recommend using a symmetric and normalized space")
@pytest.mark.filterwarnings("ignore:.*Box observation space (minimum|maximum) value is.*infinity")
@pytest.mark.filterwarnings("ignore:.*has an unconventional shape")
def test_every_observation_by_name(cart) -> None:
    env = gym.make(
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
        reward=_nothing,
        max_steps=50,
        period_s=0.01,
        render_mode="rgb_array",
        camera="eye",
    )

    check_env(env, skip_render_check=True, skip_close_check=True)
    env.reset(seed=1)
    seen = env.step(np.array([5.0], dtype=np.float32))[0]

    assert (env.observation_space["q"].low, env.observation_space["q"].high) == (-1.5, 0.5)
    assert (env.action_space.low, env.action_space.high) == (-5.0, 5.0)
    assert seen["v"] > 0.1
    assert seen["tip"] == pytest.approx([0.0, 0.0, 0.05], abs=1e-6)
    assert seen["scan"].shape == (5,)
    assert 0.1 < seen["scan"].min() < 1.0
    assert seen["time"] == pytest.approx(0.01)
    assert (env.render() == seen["eye"]).all()


def test_the_environment_is_the_simulation_of_the_python_api(cart) -> None:
    env = gym.make(cart, reward=_nothing, **HINGE)
    sim = trundle.load(cart)
    hinge = sim["cart"].joint("hinge")
    env.reset()
    for target in (0.4, -1.0, 0.2):
        env.step(np.array([target], dtype=np.float32))
        hinge.command_position(float(np.float32(target)))
        sim.run(0.02)

    assert env.worlds.states.joint_positions("hinge")[0].tolist() == sim["cart"].joint_positions.tolist()
    assert env.worlds.states.link_poses("base")[0].tolist() == sim.engine.reader.link_poses()[0].tolist()


def test_a_reset_returns_to_the_loaded_state_and_draws_the_tasks_own(cart) -> None:
    def tilt(simulation, random) -> None:
        simulation["cart"].joint("hinge").set_position(random.uniform(-1.0, 0.0))

    env = gym.make(cart, reward=_nothing, reset=tilt, max_steps=3, **HINGE)
    compiled = env.worlds.states.simulation.engine.compiled
    first = env.reset(seed=3)[0].tobytes()
    second = env.reset()[0].tobytes()
    truncated = [env.step(env.action_space.sample())[3] for _ in range(3)]

    assert first != second
    assert truncated == [False, False, True]
    assert env.reset(seed=3)[0].tobytes() == first
    assert env.worlds.states.simulation.engine.compiled is compiled


def test_unstable_physics_ends_the_episode_of_that_world_alone(cart) -> None:
    envs = gym.make_vec(cart, num_envs=2, reward=_nothing, **HINGE)
    envs.reset(seed=0)
    envs.worlds.states.batch.states[1, 9] = 1e9

    _, _, terminated, _, infos = envs.step(np.zeros((2, 1), dtype=np.float32))

    assert terminated.tolist() == [False, True]
    assert infos["unstable"].tolist() == [False, True]
    assert np.isfinite(envs.step(np.zeros((2, 1), dtype=np.float32))[0]).all()


def test_a_world_built_in_code(cart) -> None:
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
        reward=_nothing,
    )

    env.reset(seed=0)
    for _ in range(10):
        seen = env.step(np.array([1.0], dtype=np.float32))[0]

    assert seen[0] == pytest.approx(0.2, abs=0.02)


@pytest.mark.parametrize(
    ("change", "says"),
    [
        ({"observations": gym.JointPositions("knee")}, "no joint 'knee'; there are: 'cart::hinge'"),
        ({"observations": gym.LinkPose("hand")}, "no link 'hand'; there are: 'cart::base'"),
        ({"observations": gym.LidarRanges("radar")}, "no lidar 'radar'; there are: 'cart::base::laser'"),
        ({"observations": [gym.CameraPicture("eye"), gym.LinkPose("arm")]}, "name them"),
        ({"actions": gym.TwistAction("cart", max_forward=1.0, max_yaw_rate=1.0)}, "has no plugin"),
        ({"period_s": 0.0015}, "no multiple"),
        ({"render_mode": "human"}, "rgb_array"),
    ],
)
def test_what_cannot_be_done_is_said(cart, change, says) -> None:
    with pytest.raises(UsageError, match=says):
        gym.make(cart, **{"reward": _nothing, **HINGE, **change})


def test_a_wrong_action_or_reward_is_said(cart) -> None:
    env = gym.make(cart, reward=_nothing, **HINGE)
    env.reset()
    with pytest.raises(UsageError, match=r"shape \(1, 2\), not \(1, 1\)"):
        env.step(np.zeros(2, dtype=np.float32))
    with pytest.raises(UsageError, match="not finite"):
        env.step(np.array([np.nan], dtype=np.float32))
    scalar = gym.make(cart, reward=lambda states: float(states.rows), **HINGE)
    scalar.reset()
    with pytest.raises(UsageError, match="a value for each world"):
        scalar.step(np.zeros(1, dtype=np.float32))


def test_without_gymnasium_a_sentence_says_what_to_install() -> None:
    code = "import sys; sys.modules['gymnasium'] = None\nimport trundle.gym"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)

    assert "trundle.gym needs the package 'gymnasium': pip install 'trundle[gym]'" in done.stderr


def test_the_ready_ones_are_registered() -> None:
    assert {name for name in gymnasium.registry if name.startswith("Trundle/")} == {
        "Trundle/ArmReach-v0",
        "Trundle/CartPole-v0",
        "Trundle/DriveToGoal-v0",
    }

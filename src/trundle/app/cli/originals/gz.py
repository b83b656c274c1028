"""Check SDF files and control a running world, as Gazebo's gz does."""

import argparse
import sys
import time
from collections.abc import Mapping
from typing import Any

from trundle.base.diagnostics import UsageError
from trundle.base.files import read_text

from ..graph_command import running_node
from .waiting import wait_for_master

EXAMPLES = """
  gz sdf -k model.sdf           check a file
  gz sdf -p robot.urdf          print it as SDF
  gz model -m box -f box.sdf    put a model into the running world
  gz model -m box -d            remove it
  gz world -p 1                 pause; 0: go on
  gz stats -d 5                 speed of the simulation
  gz topic -l                   topics, which are ROS' here
"""
_POSE = (("x", "X"), ("y", "Y"), ("z", "Z"), ("roll", "R"), ("pitch", "P"), ("yaw", "A"))
_PERIOD_S = 1.0
_START_S = 10.0
"""Timeout for a starting server [s]; there may be none."""
_STEPS = "stepping a world from outside is not supported; the page has buttons for it"


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    add = commands.add_parser("sdf", help="check, print and convert SDF files")
    action = add.add_mutually_exclusive_group(required=True)
    action.add_argument("-k", "--check", metavar="FILE", help="check a file")
    action.add_argument("-p", "--print", metavar="FILE", help="print a file as SDF")
    add.set_defaults(run=_sdf)
    add = commands.add_parser("model", help="add, remove and move models of the running world")
    add.add_argument("-m", "--model-name", required=True, metavar="NAME", help="its name in the world")
    action = add.add_mutually_exclusive_group()
    action.add_argument("-f", "--spawn-file", metavar="FILE", help="add a model from a file")
    action.add_argument("-s", "--spawn-string", action="store_true", help="add a model from standard input")
    action.add_argument("-d", "--delete", action="store_true", help="remove it")
    action.add_argument("-i", "--info", action="store_true", help="print its links and joints")
    action.add_argument("-p", "--pose", action="store_true", help="print its pose [m, rad]")
    for (name, metavar), letter in zip(_POSE, "xyzRPY", strict=True):
        add.add_argument(f"-{letter}", f"--pose-{name}", dest=name, type=float, metavar=metavar, help="[m] or [rad]")
    add.set_defaults(run=_model)
    add = commands.add_parser("world", help="pause and reset the running world")
    action = add.add_mutually_exclusive_group(required=True)
    action.add_argument("-p", "--pause", type=int, choices=(0, 1), help="1: pause, 0: go on")
    action.add_argument("-r", "--reset-all", action="store_true", help="reset time and models")
    action.add_argument("-o", "--reset-models", action="store_true", help="reset models")
    for option in (("-s", "--step"), ("-t", "--reset-time")):
        action.add_argument(*option, action="store_true", help=argparse.SUPPRESS)
    action.add_argument("-m", "--multi-step", help=argparse.SUPPRESS)
    add.set_defaults(run=_world)
    add = commands.add_parser("stats", help="print the speed of the simulation every second")
    add.add_argument("-d", "--duration", type=float, metavar="S", help="stop after this time")
    add.add_argument("-p", "--plot", action="store_true", help="comma-separated")
    add.set_defaults(run=_stats)
    add = commands.add_parser("topic", help="list, print and measure topics")
    action = add.add_mutually_exclusive_group(required=True)
    action.add_argument("-l", "--list", action="store_true", help="list all topics")
    for letter, subcommand in (("i", "info"), ("e", "echo"), ("z", "hz"), ("b", "bw")):
        action.add_argument(f"-{letter}", f"--{subcommand}", metavar="TOPIC", help=f"as rostopic {subcommand}")
    add.set_defaults(run=_topic)


def main(args: argparse.Namespace) -> int:
    """Run the subcommand."""
    return args.run(args)


def _sdf(args: argparse.Namespace) -> int:
    if args.check is None:
        return args.run_command(("convert",), [args.print, "--to", "sdf"])
    code = args.run_command(("check",), [args.check])
    if code == 0:
        print("Check complete")
    return code


def _topic(args: argparse.Namespace) -> int:
    for subcommand in ("info", "echo", "hz", "bw"):
        if (topic := getattr(args, subcommand)) is not None:
            return args.run_command(("topic",), [subcommand, topic])
    return args.run_command(("topic",), ["list"])


def _world(args: argparse.Namespace) -> int:
    if args.step or args.multi_step or args.reset_time:
        raise UsageError(_STEPS if not args.reset_time else "time is reset with the models: gz world -r")
    names = {"reset_all": "reset_simulation", "reset_models": "reset_world"}
    service = next((name for option, name in names.items() if getattr(args, option)), "")
    with _Gazebo() as gazebo:
        gazebo.call(service or ("pause_physics" if args.pause else "unpause_physics"), "std_srvs/Empty")
    return 0


def _model(args: argparse.Namespace) -> int:
    name = args.model_name
    with _Gazebo() as gazebo:
        if args.delete:
            gazebo.change("delete_model", "gazebo_msgs/DeleteModel", {"model_name": name})
        elif args.spawn_file is not None or args.spawn_string:
            text = sys.stdin.read() if args.spawn_file is None else read_text(args.spawn_file)
            request = {"model_name": name, "model_xml": text, "initial_pose": _ros_pose(args, [0.0] * 6)}
            gazebo.change("spawn_sdf_model", "gazebo_msgs/SpawnModel", request)
        elif args.info:
            properties = gazebo.change("get_model_properties", "gazebo_msgs/GetModelProperties", {"model_name": name})
            for kind, names in (("link", properties.body_names), ("joint", properties.joint_names)):
                print("".join(f'{kind} {{\n  name: "{name}"\n}}\n' for name in names), end="")
        else:
            now = _pose_of(gazebo, name)
            if args.pose or all(getattr(args, field) is None for field, _ in _POSE):
                print(" ".join(f"{value:g}" for value in now))
            else:
                state = {"model_name": name, "pose": _ros_pose(args, now)}
                gazebo.change("set_model_state", "gazebo_msgs/SetModelState", {"model_state": state})
    return 0


def _pose_of(gazebo: "_Gazebo", name: str) -> list[float]:
    """Return x, y, z, roll, pitch, yaw of a model [m, rad]."""
    from trundle.spatial import rpy_from_quaternion

    pose = gazebo.change("get_model_state", "gazebo_msgs/GetModelState", {"model_name": name}).pose
    at, q = pose.position, pose.orientation
    return [at.x, at.y, at.z, *rpy_from_quaternion((q.w, q.x, q.y, q.z))]


def _ros_pose(args: argparse.Namespace, defaults: list[float]) -> dict[str, Any]:
    """Return the pose of the options as geometry_msgs/Pose; `defaults` is x, y, z, roll, pitch, yaw [m, rad]."""
    from trundle.spatial import quaternion_from_rpy

    options = [getattr(args, name) for name, _ in _POSE]
    x, y, z, *rpy = (default if value is None else value for value, default in zip(options, defaults, strict=True))
    w, qx, qy, qz = quaternion_from_rpy(*rpy)
    return {"position": {"x": x, "y": y, "z": z}, "orientation": {"x": qx, "y": qy, "z": qz, "w": w}}


def _stats(args: argparse.Namespace) -> int:
    """Print lines in Gazebo's format; real time counts from the start of this command."""
    if args.plot:
        print("# real-time factor (percent), simtime (sec), realtime (sec), paused (T or F)", flush=True)
    with _Gazebo() as gazebo:
        started = last = time.monotonic()
        simulated = _time_s(gazebo)
        while args.duration is None or last - started < args.duration:
            time.sleep(_PERIOD_S)
            now, now_simulated = time.monotonic(), _time_s(gazebo)
            factor = (now_simulated - simulated) / (now - last)
            is_paused = gazebo.call("get_physics_properties", "gazebo_msgs/GetPhysicsProperties").pause
            last, simulated = now, now_simulated
            paused = "T" if is_paused else "F"
            if args.plot:
                print(f"{factor:.2f}, {simulated:.2f}, {now - started:.2f}, {paused}", flush=True)
            else:
                real = f"RealTime[{now - started:.2f}] Paused[{paused}]"
                print(f"Factor[{factor:.2f}] SimTime[{simulated:.2f}] {real}", flush=True)
    return 0


def _time_s(gazebo: "_Gazebo") -> float:
    return float(gazebo.call("get_world_properties", "gazebo_msgs/GetWorldProperties").sim_time)


class _Gazebo:
    """Services of /gazebo on the graph."""

    def __enter__(self) -> "_Gazebo":
        wait_for_master("gz", _START_S)
        self._running = running_node("gz")
        self._loop, self._node = self._running.__enter__()
        return self

    def __exit__(self, *error: Any) -> None:
        self._running.__exit__(*error)

    def call(self, service: str, kind: str, request: Mapping[str, Any] | None = None) -> Any:
        """Call a service.

        Raises:
            UsageError: no such service, or it does not answer.
        """
        from trundle.ros import RosError

        try:
            self._loop.run(self._node.wait_for_service(f"/gazebo/{service}", _START_S), None)
            calling = self._node.call_service(f"/gazebo/{service}", kind, dict(request or {}))
            return self._loop.run(calling, None)
        except RosError as error:
            raise UsageError(f"{error}; start a world with gazebo, gzserver or a launch file") from None

    def change(self, service: str, kind: str, request: Mapping[str, Any]) -> Any:
        """Call a service that reports its success.

        Raises:
            UsageError: it failed.
        """
        response = self.call(service, kind, request)
        if not response.success:
            raise UsageError(response.status_message)
        return response

"""Starts a compiled program as its repository's launch file does, on a master of its own."""

import shlex
import subprocess
import tempfile
import time
from typing import IO

from trundle.robots.launch import ParamCommand
from trundle.ros import Core, GraphLoop, MasterProxy, MessageError, Node, RosError
from trundle.ros.node.publisher import Publisher

from .inputs import fields_of
from .workspace import Target, Workspace

_START_S, _PUBLISH_S, _SILENT_S, _POLL_S, _PERIOD_S = 20.0, 10.0, 3.0, 0.1, 0.05
_MAX_LENGTH = 120


class ProgramRun:
    """Master, and a program that is started there."""

    def __init__(self, workspace: Workspace, target: Target, home: str) -> None:
        """Prepare a run.

        Args:
            workspace: compiled workspace.
            target: its program.
            home: folder in which the program runs.
        """
        self._workspace, self._target, self._home = workspace, target, home

    def result(self) -> tuple[str, str]:
        """Start the program; return how it started, and what it does."""
        with GraphLoop() as loop:
            core = Core(loop, port=0)
            loop.run(core.start(), 60)
            loop.run(core.wait_ready(), 60)
            try:
                with tempfile.TemporaryFile() as output:
                    process = self._start(core.uri, output)
                    try:
                        started = self._wait(process, core.uri, output)
                        return started, self._act(process, core.uri, loop) if started == "starts" else ""
                    finally:
                        process.kill()
                        process.wait()
            finally:
                loop.run(core.stop(), 60)

    def _start(self, uri: str, output: IO[bytes]) -> "subprocess.Popen[bytes]":
        file = self._target.file
        assert file is not None
        found = self._workspace.launch_of(self._target)
        command = [str(file)]
        environment = self._workspace.running_environment(ROS_MASTER_URI=uri, ROS_HOME=self._home)
        if found is not None:
            plan, node = found
            for param in plan.params:
                if not isinstance(param.value, ParamCommand):
                    MasterProxy(uri).call("setParam", param.name, param.value)
            command += (
                shlex.split(node.arguments) + [f"{a}:={b}" for a, b in node.remappings] + [f"__name:={node.name}"]
            )
            environment |= {"ROS_NAMESPACE": node.namespace, **dict(node.env)}
        return subprocess.Popen(
            command, env=environment, cwd=self._home, stdin=subprocess.DEVNULL, stdout=output, stderr=output
        )

    def _wait(self, process: "subprocess.Popen[bytes]", uri: str, output: IO[bytes]) -> str:
        end = time.monotonic() + _START_S
        while process.poll() is None and time.monotonic() < end:
            if _is_registered(uri):
                return "starts"
            time.sleep(_POLL_S)
        if process.poll() is None:
            return "runs, but does not register"
        output.seek(0)
        lines = output.read().decode(errors="replace").strip().splitlines()
        last = lines[-1][:_MAX_LENGTH] if lines else ""
        return "ends" if process.returncode == 0 else f"exit code {process.returncode}: {last}"

    def _act(self, process: "subprocess.Popen[bytes]", uri: str, loop: GraphLoop) -> str:
        """Publish what the program subscribes to; return what it registers, and on how many topics messages came."""
        node = Node("bench_cpp_nodes", loop=loop, master_uri=uri, rosout=False)
        for name, folder in self._workspace.folders.items():
            node.messages.add_package(name, folder)
        received: set[str] = set()
        inputs: dict[str, tuple[Publisher, str]] = {}
        outputs: set[str] = set()
        services: set[str] = set()
        begin = time.monotonic()
        try:
            while (now := time.monotonic()) < begin + _PUBLISH_S:
                published, subscribed, services_now = _names_of_others(uri)
                services |= services_now
                types = dict(MasterProxy(uri).call("getTopicTypes"))
                for topic in published - subscribed - outputs:
                    outputs.add(topic)
                    node.subscribe(topic, types[topic], lambda _, topic=topic: received.add(topic))
                for topic in subscribed - inputs.keys():
                    inputs[topic] = node.advertise(topic, types[topic]), types[topic]
                for publisher, kind in inputs.values():
                    publisher.publish(node.messages.new(kind, fields_of(kind)))
                if received == outputs and (outputs or now > begin + _SILENT_S):
                    break
                time.sleep(_PERIOD_S)
        except (MessageError, KeyError) as error:
            return str(error)
        finally:
            loop.run(node.shutdown(), 60)
        state = "" if process.poll() in (None, 0) else f"; then exit code {process.returncode}"
        return (
            f"publishes on {len(received)} of {len(outputs)} topics, subscribes to {len(inputs)}, "
            f"offers {len(services)} services{state}"
        )


def _is_registered(uri: str) -> bool:
    """Return whether a node has registered, be it with its log alone."""
    try:
        published, _, services = MasterProxy(uri).call("getSystemState")
    except RosError:
        return False
    return any({*nodes} - {"/rosout"} for _, nodes in [*published, *services])


def _names_of_others(uri: str) -> tuple[set[str], set[str], set[str]]:
    """Return topics published and subscribed to, and services offered, by the program."""
    try:
        state = MasterProxy(uri).call("getSystemState")
    except RosError:
        return set(), set(), set()
    own = {"/rosout", "/bench_cpp_nodes"}
    published, subscribed, services = ({name for name, nodes in kind if {*nodes} - own} for kind in state)
    offered = {name for name in services if not name.endswith(("/get_loggers", "/set_logger_level"))}
    return published - {"/rosout"}, subscribed - {"/clock"}, offered

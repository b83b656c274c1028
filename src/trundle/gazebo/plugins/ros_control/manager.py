"""controller_manager: services that load, switch and unload controllers."""

import math
import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Message, Node
from trundle.sim.control import Servo
from trundle.sim.simulation import ModelHandle

from ._compiled_control import CompiledRobot
from .catalog import CONTROLLERS, find_controller
from .compiled import CompiledController, CompiledRobots
from .controller import Controller, ControllerContext, InStepController
from .exported_class import ExportedClass, exported_classes
from .hardware import Hardware

if TYPE_CHECKING:
    from trundle.ros.message_types import controller_manager_msgs

_STRICT = 2
_PACKAGE = "controller_manager_msgs"


@dataclass(slots=True, kw_only=True)
class _Loaded:
    name: str
    type: str
    controller: Controller
    state: Literal["initialized", "running", "stopped"] = "initialized"


class ControllerManager:
    """Services `<robot>/controller_manager/…`, all on the simulation's thread."""

    def __init__(
        self,
        node: Node,
        namespace: str,
        hardware: Hardware,
        servo: Servo,
        model: ModelHandle,
        *,
        robot: CompiledRobot | None = None,
        world_file: str = "",
    ) -> None:
        """Advertise.

        Args:
            node: advertises the services.
            namespace: robot's namespace: '/' or '/rrbot'.
            hardware: robot's joints.
            servo: runner of the controllers' laws.
            model: robot's model.
            robot: hardware in C++, if the robot has its own.
            world_file: file of the world; packages of its workspace may have controllers in C++.
        """
        self._node = node
        self._robots = CompiledRobots(hardware, robot)
        self._files = [Path(model.model.at.file), Path(world_file)]
        self._exported: dict[str, ExportedClass] | None = None
        self._namespace = namespace.rstrip("/")
        self._hardware = hardware
        self._model = model
        self._servo = servo
        self._loaded: dict[str, _Loaded] = {}
        services: tuple[tuple[str, str, Callable[[Message], dict[str, Any]]], ...] = (
            ("list_controllers", "ListControllers", self._list),
            ("list_controller_types", "ListControllerTypes", self._types),
            ("load_controller", "LoadController", lambda request: {"ok": self._load(request.name)}),
            ("unload_controller", "UnloadController", lambda request: {"ok": self._unload(request.name)}),
            ("switch_controller", "SwitchController", lambda request: {"ok": self._switch(request)}),
            ("reload_controller_libraries", "ReloadControllerLibraries", lambda _: {"ok": self._reload()}),
        )
        for name, kind, handler in services:
            node.advertise_service(f"{self._namespace}/controller_manager/{name}", f"{_PACKAGE}/{kind}", handler)

    def begin_stride(self) -> None:
        """Let the controllers in C++ act again at times that they have acted at."""
        for controller in self._running:
            if isinstance(controller, CompiledController):
                controller.begin_stride()

    def update(self, time_ns: int, dt: float) -> None:
        """Update every running controller, after the laws."""
        for controller in self._running:
            controller.update(time_ns, dt)

    def due_ns(self, time_ns: int) -> float | None:
        """Return the time of the next `update` after an update [ns]; None: at every step."""
        running = self._running
        due_ns = [controller.due_ns(time_ns) for controller in running if isinstance(controller, InStepController)]
        return min(due_ns, default=math.inf) if len(due_ns) == len(running) else None

    def finish_stride(self) -> None:
        """Finish the stride of the controllers with laws in C++."""
        for controller in self._running:
            if isinstance(controller, InStepController):
                controller.finish_stride()

    def restart(self, time_ns: int) -> None:
        """Restart the running controllers after a reset or an emergency stop."""
        for controller in self._running:
            controller.stop()
            controller.start(time_ns)

    @property
    def _running(self) -> list[Controller]:
        return [loaded.controller for loaded in self._loaded.values() if loaded.state == "running"]

    def _types(self, _request: "controller_manager_msgs.ListControllerTypesRequest") -> dict[str, Any]:
        names = sorted({*CONTROLLERS, *self._find_exported()})
        return {"types": names, "base_classes": ["controller_interface::ControllerBase"] * len(names)}

    def _list(self, _request: "controller_manager_msgs.ListControllersRequest") -> dict[str, Any]:
        return {
            "controller": [
                {
                    "name": loaded.name,
                    "state": loaded.state,
                    "type": loaded.type,
                    "claimed_resources": [
                        {"hardware_interface": f"hardware_interface::{interface}", "resources": joints}
                        for interface, joints in loaded.controller.claims.items()
                    ],
                }
                for loaded in self._loaded.values()
            ]
        }

    def _load(self, name: str) -> bool:
        if name in self._loaded:
            self._node.log.error(f"A controller named '{name}' was already loaded inside the controller manager")
            return False
        full = f"{self._namespace}/{name}"
        tree = self._node.loop.run(self._node.params.get(full, {}))
        settings = RosParameters(tree, full)
        try:
            kind = settings.text("type")
        except ParamError:
            self._node.log.error(
                f"Could not load controller '{name}' because the type was not specified. Did you load the controller "
                f"configuration on the parameter server (namespace: '{self._namespace or '/'}')?"
            )
            return False
        context = ControllerContext(
            name=full,
            namespace=self._namespace,
            node=self._node,
            settings=settings,
            hardware=self._hardware,
            model=self._model,
        )
        try:
            controller = self._make(kind, context)
        except ParamError as error:
            self._node.log.error(f"Could not load controller '{name}': {error}")
            return False
        self._loaded[name] = _Loaded(name=name, type=kind, controller=controller)
        return True

    def _make(self, kind: str, context: ControllerContext) -> Controller:
        """Return a controller: a package's compiled one, else one of Trundle's.

        Raises:
            ParamError: it cannot be made.
        """
        if kind not in CONTROLLERS:
            self._exported = None  # it may have been compiled since
        found = self._find_exported().get(kind)
        if found is None or (found.library is None and kind in CONTROLLERS):
            return find_controller(kind).create(context)
        controller = CompiledController(context, self._robots, found)
        self._node.log.info(f"controller {context.name}: {found.library}, in C++")
        return controller

    def _find_exported(self) -> dict[str, ExportedClass]:
        """Return the controllers that packages export; they are looked for once, or after a reload of the libraries."""
        if self._exported is None:
            self._exported = exported_classes("controller_interface", os.environ, self._files)
        return self._exported

    def _reload(self) -> bool:
        self._exported = None
        return True

    def _unload(self, name: str) -> bool:
        loaded = self._loaded.get(name)
        if loaded is None:
            self._node.log.error(
                f"Could not unload controller with name '{name}' because no controller with this name exists"
            )
            return False
        if loaded.state == "running":
            self._node.log.error(f"Could not unload controller with name '{name}' because it is still running")
            return False
        loaded.controller.close()
        del self._loaded[name]
        return True

    def _switch(self, request: "controller_manager_msgs.SwitchControllerRequest") -> bool:
        strict = request.strictness == _STRICT
        stops, starts = (
            [str(name) for name in names] for names in (request.stop_controllers, request.start_controllers)
        )
        errors = [self._switch_error(name, "running") for name in stops]
        errors += [self._switch_error(name, "") for name in starts if name not in stops]
        for error in filter(None, errors):
            self._node.log.error(error)
        if strict and any(errors):
            return False
        stops = [n for n in stops if n in self._loaded and self._loaded[n].state == "running"]
        starts = [n for n in starts if n in self._loaded and (n in stops or self._loaded[n].state != "running")]
        conflict = self._conflict(stops, starts)
        if conflict:
            self._node.log.error(conflict)
            return False
        for name in stops:
            self._loaded[name].controller.stop()
            self._loaded[name].state = "stopped"
        for joint in self._hardware.values():
            joint.read()
        for name in starts:
            self._loaded[name].controller.start(self._servo.time_ns)
            self._loaded[name].state = "running"
        running = [controller for controller in self._running if isinstance(controller, InStepController)]
        self._servo.set_laws([law for controller in running for law in controller.laws])
        return True

    def _switch_error(self, name: str, state: str) -> str:
        """Return why a controller cannot be stopped (`state` "running") or started (`state` ""); empty if it can be."""
        loaded = self._loaded.get(name)
        if loaded is None:
            verb = "stop" if state else "start"
            return f"Could not {verb} controller with name '{name}' because no controller with this name exists"
        if state and loaded.state != state:
            return f"Could not stop controller '{name}' since it is not running"
        if not state and loaded.state == "running":
            return f"Controller '{name}' is already running"
        return ""

    def _conflict(self, stops: list[str], starts: list[str]) -> str:
        """Return an error message if two controllers would command one joint; empty: no conflict."""
        runs = [n for n, loaded in self._loaded.items() if loaded.state == "running" and n not in stops]
        claimed: dict[str, str] = {}
        for name in (*runs, *starts):
            for joint in (joint for joints in self._loaded[name].controller.claims.values() for joint in joints):
                if claimed.setdefault(joint, name) != name:
                    controllers = f"'{claimed[joint]}' and '{name}'"
                    return (
                        f"Resource conflict: joint '{joint}' would be commanded by {controllers}; nothing was switched"
                    )
        return ""

"""controller_manager: services that load, switch and unload controllers."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Message, Node
from trundle.sim.control import Servo
from trundle.sim.simulation import ModelHandle

from .catalog import CONTROLLERS, find_controller
from .controller import Controller, ControllerContext, InStepController
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

    def __init__(self, node: Node, namespace: str, hardware: Hardware, servo: Servo, model: ModelHandle) -> None:
        """Advertise.

        Args:
            node: advertises the services.
            namespace: robot's namespace: '/' or '/rrbot'.
            hardware: robot's joints.
            servo: runner of the controllers' laws.
            model: robot's model.
        """
        self._node = node
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
            ("reload_controller_libraries", "ReloadControllerLibraries", lambda _: {"ok": True}),
        )
        for name, kind, handler in services:
            node.advertise_service(f"{self._namespace}/controller_manager/{name}", f"{_PACKAGE}/{kind}", handler)

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
        names = sorted(CONTROLLERS)
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
            controller = find_controller(kind).create(context)
        except ParamError as error:
            self._node.log.error(f"Could not load controller '{name}': {error}")
            return False
        self._loaded[name] = _Loaded(name=name, type=kind, controller=controller)
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
        errors = [
            self._switch_error(name, state) for names, state in ((stops, "running"), (starts, "")) for name in names
        ]
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

"""The scene in which collisions are checked, kept equal to the contents."""

import threading
from typing import TYPE_CHECKING

import numpy as np

from trundle.base.diagnostics import Diagnostics, TrundleError
from trundle.planning.planning_scene import PlanningScene
from trundle.robots.packages import Packages
from trundle.ros import Node

from .octomap import read_octomap
from .scene_contents import SceneContents

if TYPE_CHECKING:
    from collections.abc import Callable

    from trundle.planning.robot_model import RobotModel

_MAX_WARNINGS = 20


class SceneMirror:
    """Scene of the contents last asked for; what did not change is not built again.

    Plans of a pick ask for it beside the graph's thread, which asks for it too.
    """

    def __init__(self, node: Node, model: "RobotModel", packages: Packages | None) -> None:
        """Load the robot's shapes; findings go to the log.

        Raises:
            TrundleError: the robot cannot be checked for collisions.
        """
        report = Diagnostics()
        self._node = node
        self._scene = PlanningScene(model, packages=packages, report=report)
        self._last: SceneContents | None = None
        self._lock = threading.Lock()
        for finding in report.findings[:_MAX_WARNINGS]:
            node.log.warn(finding.what)

    def scene(self, contents: SceneContents, positions: np.ndarray) -> PlanningScene:
        """Return an independent scene of contents and a state; what cannot be checked is left out with a sentence."""
        with self._lock:
            if self._last is not contents:
                self._follow(contents)
                self._last = contents
            scene = self._scene.copy()
        scene.positions = np.array(positions, dtype=np.float64)
        return scene

    def _follow(self, contents: SceneContents) -> None:
        scene, old = self._scene, self._last
        for name in [name for name in scene.attached if name not in contents.carried]:
            scene.detach(name, keep=False)
        for name in [name for name in scene.objects if name not in contents.objects]:
            scene.remove(name)
        for name, item in contents.objects.items():
            if old is None or old.objects.get(name) is not item or name not in scene.objects:
                self._try(lambda item=item: scene.add(item.collision_object()))
        for name, carried in contents.carried.items():
            if old is None or old.carried.get(name) is not carried or name not in scene.attached:
                self._try(lambda carried=carried: scene.attach(carried.attached_object()))
        if old is None or old.padding != contents.padding:
            for name, padding in contents.padding.items():
                if scene.model.has_link(name) and scene.padding(name) != padding:
                    self._try(lambda name=name, padding=padding: scene.set_padding(name, padding))
        if old is None or old.scale != contents.scale:
            for name, scale in contents.scale.items():
                if scene.model.has_link(name) and scene.scale(name) != scale:
                    self._try(lambda name=name, scale=scale: scene.set_scale(name, scale))
        if old is None or old.octomap is not contents.octomap:
            self._try(lambda: scene.set_voxels(None if contents.octomap is None else read_octomap(contents.octomap)))
        if old is None or old.allowed != contents.allowed:
            scene.allowed_collisions = contents.allowed

    def _try(self, act: "Callable[[], object]") -> None:
        try:
            act()
        except TrundleError as error:
            self._node.log.error(f"{error}; it is not checked for collisions")

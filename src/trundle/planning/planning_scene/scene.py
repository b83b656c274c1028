"""Planning scene: a robot, what it carries, and the objects around it."""

import itertools
from collections.abc import Iterable, Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from trundle.base.built import refuse_stale
from trundle.base.diagnostics import Diagnostics, UsageError, no_such
from trundle.planning import _planning
from trundle.planning.kinematics import Kinematics
from trundle.planning.robot_model import RobotModel
from trundle.robots.packages import Packages
from trundle.sim.physics import ShapePair, mujoco_addresses
from trundle.spatial import Pose

from .allowed_collisions import AllowedCollisionMatrix
from .contacts import BodyType, Contact, NearestBodies
from .link_pieces import LinkGeometry, link_geometry
from .objects import AttachedObject, CollisionObject, Voxels
from .pieces import Pieces, pieces_of, pose_row
from .scene_bodies import SceneBodies

Positions = NDArray[np.float64]
OCTOMAP = "<octomap>"
"""MoveIt's name of the voxels."""
MAX_OBJECTS = 20_000
MAX_VOXELS = 500_000
_MAX_PADDING = 10.0
"""[m]"""
_NO_MASK = np.zeros(0, dtype=np.bool_)

refuse_stale(_planning)
_planning.bind_distance(*mujoco_addresses(["mj_geomDistance"]))


class PlanningScene:
    """Robot, attached objects, objects of the world and voxels, with the pairs of them that may touch.

    Poses are in the model frame. Methods that check take states (len(model.variables),) [rad, m]; without, the scene's
    own. Several threads may check at once, one after another; only one may change the scene.
    """

    def __init__(
        self, model: RobotModel, *, packages: Packages | None = None, report: Diagnostics | None = None
    ) -> None:
        """Make a scene of a robot alone.

        Args:
            model: robot.
            packages: finds the meshes of its links.
            report: receives meshes that are left out.
        """
        geometry = link_geometry(model.urdf.links, packages, report or Diagnostics())
        self._set_up(Kinematics(model), geometry, AllowedCollisionMatrix.of_model(model))
        pair = ShapePair()
        self._pair = pair
        world = _planning.CollisionWorld(self._kinematics.tree, *pair.addresses)
        self._bodies = SceneBodies(model.links, world)
        for link in model.links:
            self._set_link(link)
        self._allow_all()

    def _set_up(self, kinematics: Kinematics, geometry: LinkGeometry, matrix: AllowedCollisionMatrix) -> None:
        self._kinematics = kinematics
        self.model = model = kinematics.model
        self.positions: Positions = model.default_positions()
        """State of the robot [rad, m]."""
        self._geometry = geometry
        self._matrix = matrix
        self._objects: dict[str, CollisionObject] = {}
        self._attached: dict[str, AttachedObject] = {}
        self._voxels: Voxels | None = None
        self._paddings: dict[str, float] = {}
        self._scales: dict[str, float] = {}
        self._link_number = {link: number for number, link in enumerate(model.links)}
        self._masks: dict[str, NDArray[np.bool_]] = {}

    @property
    def objects(self) -> Mapping[str, CollisionObject]:
        """Objects of the world by name."""
        return MappingProxyType(self._objects)

    @property
    def attached(self) -> Mapping[str, AttachedObject]:
        """Objects that links carry, by name."""
        return MappingProxyType(self._attached)

    @property
    def voxels(self) -> Voxels | None:
        """Voxels of the octomap."""
        return self._voxels

    @property
    def allowed_collisions(self) -> AllowedCollisionMatrix:
        """Copy of the matrix of pairs that may touch; set it to change it."""
        return self._matrix.copy()

    @allowed_collisions.setter
    def allowed_collisions(self, matrix: AllowedCollisionMatrix) -> None:
        self._matrix = matrix.copy()
        self._allow_all()

    def add(self, object: CollisionObject) -> None:
        """Add an object to the world, in place of one of the same name.

        Raises:
            UsageError: a shape or pose that cannot be, a name that a link or attached object has, or too many objects.
        """
        if object.name in self._link_number or object.name in self._attached or object.name == OCTOMAP:
            owner = "an attached object" if object.name in self._attached else "a part of the robot or scene"
            raise UsageError(f"{owner} is called {object.name!r}; an object needs another name")
        if len(self._objects) >= MAX_OBJECTS and object.name not in self._objects:
            raise UsageError(f"a scene has at most {MAX_OBJECTS} objects; {object.name!r} is one more")
        pieces = pieces_of(object.shapes, object.name, moves=False)
        self._set_body(object.name, -1, 0.0, pieces, object.pose)
        self._objects[object.name] = object

    def remove(self, name: str) -> CollisionObject:
        """Remove an object of the world and return it.

        Raises:
            UsageError: no such object.
        """
        object = self._object(name)
        del self._objects[name]
        self._bodies.remove(name)
        return object

    def move(self, name: str, pose: Pose) -> None:
        """Move an object of the world to a pose.

        Raises:
            UsageError: no such object, or no pose.
        """
        self.add(_moved(self._object(name), pose))

    def _object(self, name: str) -> CollisionObject:
        if name not in self._objects:
            raise UsageError(no_such("no object", name, self._objects))
        return self._objects[name]

    def attach(self, attached: AttachedObject) -> None:
        """Attach an object to a link; one of the same name leaves the world, or its link.

        Raises:
            UsageError: no such link, or a shape or pose that cannot be.
        """
        name = attached.object.name
        if attached.link not in self._link_number:
            raise UsageError(no_such("no link", attached.link, self.model.links))
        if name in self._link_number or name == OCTOMAP:
            raise UsageError(f"a part of the robot or scene is called {name!r}; an object needs another name")
        pieces = pieces_of(attached.object.shapes, name, moves=True)
        pose_row(attached.object.pose)  # refuses what is none before anything changes
        self._objects.pop(name, None)
        if name in self._bodies:
            self._bodies.remove(name)
        self._attached[name] = attached
        link = self._link_number[attached.link]
        self._set_body(name, link, self._paddings.get(name, 0.0), pieces, attached.object.pose)

    def attach_object(self, name: str, link: str, touch_links: Iterable[str] = ()) -> AttachedObject:
        """Attach an object of the world to a link where it is now.

        Raises:
            UsageError: no such object or link.
        """
        object = self._object(name)
        if link not in self._link_number:
            raise UsageError(no_such("no link", link, self.model.links))
        pose = self.link_pose(link).inverse() @ object.pose
        attached = AttachedObject(object=_moved(object, pose), link=link, touch_links=frozenset(touch_links))
        self.attach(attached)
        return attached

    def detach(self, name: str, *, keep: bool = True) -> AttachedObject:
        """Detach an object and return it; it stays in the world where it is now, unless `keep` is False.

        Raises:
            UsageError: no such attached object.
        """
        if name not in self._attached:
            raise UsageError(no_such("no attached object", name, self._attached))
        attached = self._attached.pop(name)
        self._bodies.remove(name)
        if keep:
            self.add(_moved(attached.object, self.link_pose(attached.link) @ attached.object.pose))
        return attached

    def set_voxels(self, voxels: Voxels | None) -> None:
        """Replace the octomap's voxels; None: there are none.

        Raises:
            UsageError: too many, or numbers that are no lengths.
        """
        if voxels is None or not len(voxels.centers):
            self._voxels = None
            if OCTOMAP in self._bodies:
                self._bodies.remove(OCTOMAP)
            return
        centers = np.ascontiguousarray(voxels.centers, dtype=np.float64).reshape(-1, 3)
        sizes = np.ascontiguousarray(voxels.sizes, dtype=np.float64).ravel()
        if len(centers) > MAX_VOXELS:
            raise UsageError(
                f"an octomap of {len(centers)} voxels; at most {MAX_VOXELS} are checked: a coarser one helps"
            )
        if len(sizes) != len(centers) or not np.isfinite(centers).all() or not ((sizes > 0) & (sizes < 1e3)).all():
            raise UsageError("voxels need finite centers (N, 3) and sizes (N,) above zero, in metres")
        number = self._bodies.number(OCTOMAP)
        self.world.set_voxels(number, 0.0, centers, sizes, np.array([pose_row(voxels.pose)]))
        self._voxels = voxels
        self._allow_body(OCTOMAP)

    def padding(self, name: str) -> float:
        """Return the padding of a link or attached object [m]."""
        return self._paddings.get(name, 0.0)

    def scale(self, link: str) -> float:
        """Return the scale of a link's shapes."""
        return self._scales.get(link, 1.0)

    def set_padding(self, name: str, padding: float) -> None:
        """Keep everything a distance [m] away from a link or attached object.

        Raises:
            UsageError: no such link or attached object, or no length.
        """
        if not 0.0 <= padding <= _MAX_PADDING:
            raise UsageError(f"a padding is from 0 to {_MAX_PADDING:g} m, got {padding}")
        if name in self._attached:
            self._paddings[name] = padding
            self.attach(self._attached[name])
            return
        self._check_link(name)
        self._paddings[name] = padding
        self._set_link(name)

    def set_scale(self, link: str, scale: float) -> None:
        """Scale the shapes of a link.

        Raises:
            UsageError: no such link, or a scale that is not above zero.
        """
        if not 0.0 < scale <= 100.0:
            raise UsageError(f"a scale is above 0 and at most 100, got {scale}")
        self._check_link(link)
        self._scales[link] = scale
        self._set_link(link)

    def check(
        self,
        positions: Positions | None = None,
        *,
        group: str | None = None,
        max_contacts: int = 100,
        max_contacts_per_pair: int = 1,
    ) -> list[Contact]:
        """Return the contacts of bodies that may not touch.

        Args:
            positions: state; None: the scene's.
            group: only contacts of links that move with it, and of what they carry; None: all.
            max_contacts: greatest number.
            max_contacts_per_pair: greatest number of one pair of bodies.

        Raises:
            UsageError: no such group, or no state.
        """
        rows = self.world.contacts(self._state(positions), self.mask(group), max_contacts, max_contacts_per_pair)
        return [
            Contact(
                body_1=self._bodies.name(a),
                type_1=self._type(a),
                body_2=self._bodies.name(b),
                type_2=self._type(b),
                depth=depth,
                position=position,
                normal=normal,
            )
            for a, b, depth, position, normal in rows
        ]

    def is_free(self, positions: Positions | None = None, *, group: str | None = None) -> bool:
        """Return True if no bodies touch that may not; limits are not asked.

        Raises:
            UsageError: no such group, or no state.
        """
        return self.world.is_free(self._state(positions), self.mask(group))

    def distance(
        self, positions: Positions | None = None, *, group: str | None = None, cutoff: float = 10.0
    ) -> NearestBodies:
        """Return the nearest pair of bodies that may not touch.

        Args:
            positions: state; None: the scene's.
            group: only pairs with links that move with it; None: all.
            cutoff: distance beyond which nothing is looked for [m].

        Raises:
            UsageError: no such group, or no state.
        """
        distance, a, b, on_a, on_b = self.world.nearest(self._state(positions), self.mask(group), cutoff)
        if a < 0:
            return NearestBodies(distance=float("inf"))
        return NearestBodies(
            distance=distance, body_1=self._bodies.name(a), body_2=self._bodies.name(b), point_1=on_a, point_2=on_b
        )

    def frame_pose(self, frame: str) -> Pose:
        """Return the pose of a frame: a link, the model frame, an object, or OBJECT/SUBFRAME.

        Raises:
            UsageError: no such frame.
        """
        if frame in ("", self.model.model_frame):
            return Pose()
        if frame in self._link_number:
            return self.link_pose(frame)
        name, _, subframe = frame.partition("/")
        for candidate, part in ((frame, ""), (name, subframe)):
            object = self._objects.get(candidate)
            pose = None if object is None else object.pose
            if object is None and candidate in self._attached:
                object = self._attached[candidate].object
                pose = self.link_pose(self._attached[candidate].link) @ object.pose
            if object is not None and pose is not None:
                if not part:
                    return pose
                if part in object.subframes:
                    return pose @ object.subframes[part]
        frames = [self.model.model_frame, *self.model.links, *self._objects, *self._attached]
        raise UsageError(no_such("no frame", frame, frames))

    def link_pose(self, link: str, positions: Positions | None = None) -> Pose:
        """Return the pose of a link in the model frame.

        Raises:
            UsageError: no such link, or no state.
        """
        self._check_link(link)
        return self._kinematics.link_pose(self._state(positions), link)

    def mask(self, group: str | None) -> NDArray[np.bool_]:
        """Return for each link whether it moves with a group; empty: all links count."""
        if group is None:
            return _NO_MASK
        if group not in self._masks:
            moved = set(self.model.group(group).updated_links)
            self._masks[group] = np.array([link in moved for link in self.model.links], dtype=np.bool_)
        return self._masks[group]

    @property
    def world(self) -> _planning.CollisionWorld:
        """The C++ side, for planners."""
        return self._bodies.world

    def state_check(self, group: str | None = None) -> _planning.CollisionCheck:
        """Return a check of states for solvers in C++."""
        return _planning.CollisionCheck(self.world, self.mask(group))

    def copy(self) -> "PlanningScene":
        """Return an independent scene with the same contents, as MoveIt's diff and clone; it shares the shapes."""
        scene = PlanningScene.__new__(PlanningScene)
        scene._set_up(self._kinematics, self._geometry, self._matrix.copy())
        scene.positions = self.positions.copy()
        scene._objects = dict(self._objects)
        scene._attached = dict(self._attached)
        scene._voxels = self._voxels
        scene._paddings = dict(self._paddings)
        scene._scales = dict(self._scales)
        scene._pair = ShapePair()
        scene._bodies = self._bodies.copy(self.world.copy(*scene._pair.addresses))
        return scene

    def clear_objects(self) -> None:
        """Remove all objects of the world and the voxels; attached ones stay."""
        for name in list(self._objects):
            self.remove(name)
        self.set_voxels(None)

    def _state(self, positions: Positions | None) -> Positions:
        state = np.ascontiguousarray(self.positions if positions is None else positions, dtype=np.float64)
        if state.shape != (len(self.model.variables),) or not np.isfinite(state).all():
            raise UsageError(f"a state has {len(self.model.variables)} finite numbers, one for each variable")
        return state

    def _check_link(self, link: str) -> None:
        if link not in self._link_number:
            raise UsageError(no_such("no link", link, self.model.links))

    def _type(self, number: int) -> BodyType:
        if self._bodies.is_link(number):
            return "robot_link"
        return "robot_attached" if self._bodies.name(number) in self._attached else "world_object"

    def _set_link(self, link: str) -> None:
        self._bodies.set_link(link, self.padding(link), self._geometry.pieces(link, self.scale(link)))

    def _set_body(self, name: str, link: int, padding: float, pieces: Pieces, pose: Pose) -> None:
        self._bodies.set_body(name, link, padding, pieces, pose)
        self._allow_body(name)

    def _allow_body(self, name: str) -> None:
        """Set which links and carried objects a body may touch."""
        others = [*self.model.links, *self._attached]
        if name in self._attached:
            others += [*self._objects, *([OCTOMAP] if self._voxels is not None else [])]
        for other in others:
            if other != name and other in self._bodies:
                self._bodies.allow(name, other, is_allowed=self._may_touch(name, other))

    def _allow_all(self) -> None:
        checked = [link for link in self.model.links if link in self._geometry]
        for a, b in itertools.combinations(checked, 2):
            self._bodies.allow(a, b, is_allowed=self._may_touch(a, b))
        for name in self._bodies.others:
            self._allow_body(name)

    def _may_touch(self, a: str, b: str) -> bool:
        for carried, other in ((a, b), (b, a)):
            attached = self._attached.get(carried)
            if attached is not None and other in attached.touch_links:
                return True
        return self._matrix.allows(a, b)


def _moved(object: CollisionObject, pose: Pose) -> CollisionObject:
    return CollisionObject(name=object.name, shapes=object.shapes, pose=pose, subframes=object.subframes)

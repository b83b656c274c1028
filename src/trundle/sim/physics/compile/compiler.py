"""Compiler from World to MuJoCo model.

Each link becomes a body, in any file order; a link without a parent joint is the root of a free tree. A joint whose
limits leave no freedom (the 0..0 of many published robots) is dropped: its child is fixed to its parent.
"""

import warnings
from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING

import mujoco
from msgspec.structs import replace

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.model import Collision, Heightmap, MeshFile, Plane, World, flattened
from trundle.spatial import ZERO, Pose

from ..convex.native_output import native_output_hidden
from .body_batches import BodyBatches, ignore_attach_warning
from .compiled_world import CompiledWorld, index_world
from .compliance import set_compliance
from .contact_pairs import add_contacts
from .contact_params import ContactParams
from .inertia import possible_moments, principal_inertia, set_constants
from .initial_positions import initial_positions
from .joints import JointBuilder
from .kinematic_tree import WORLD, JointEdge, KinematicTree, LinkNode
from .law_tables import fill_tables, reserve_tables
from .shape_entry import CollidesWith, ShapeEntry
from .shapes import add_shape
from .solver_settings import apply_settings, choose_jacobian
from .tunnelling import enable_ccd
from .wheels import TREAD_POINTS, tread_of, without_tread

if TYPE_CHECKING:
    from ..convex.background import BackgroundCutting
    from ..convex.mesh_decomposition import WorldDecomposition

_MANY_BODIES = 400
_BASE_BYTES, _PAIR_BYTES, _MOVING_BYTES = 64 * 2**20, 4, 512 * 2**10
"""Memory [bytes]: for any world, per pair of bodies, and for the contacts and constraints of a moving body."""
_LARGE_BYTES = 2**30
_KINEMATIC_MASS = 1e6
"""Mass factor of a kinematic link, which forces do not move noticeably."""


def compile_world(
    world: World, report: Diagnostics, *, cut_meshes: bool = True, cutting: "BackgroundCutting | None" = None
) -> CompiledWorld:
    """Compile a world; values that MuJoCo cannot use are replaced with a warning.

    Args:
        world: world, nested models allowed.
        report: receives the warnings.
        cut_meshes: decompose concave meshes into convex pieces; else each mesh is its convex hull.
        cutting: decomposes slow meshes in the background while their hulls stand in; None: all are decomposed first.

    Raises:
        DescriptionError: MuJoCo refuses the model.
    """
    return Compiler(flattened(world), report, cut_meshes=cut_meshes, cutting=cutting).compile()


class Compiler:
    """MjSpec under construction, from a world without nested models."""

    def __init__(
        self, world: World, report: Diagnostics, *, cut_meshes: bool = True, cutting: "BackgroundCutting | None" = None
    ) -> None:
        self.cuts_meshes = cut_meshes
        self._cutting = cutting
        self.decomposition: WorldDecomposition | None = None
        """Mesh decomposition; None until it is computed."""
        self.world = world
        self.report = report
        self.spec = mujoco.MjSpec()
        self.spec.modelname = world.name
        apply_settings(self.spec)
        self.spec.option.timestep = world.physics.max_step_size_s
        self.spec.option.gravity = world.physics.gravity
        self.tree = KinematicTree.from_world(world, report)
        self.joints = JointBuilder(self.spec, report)
        self.batches = BodyBatches(self.spec)
        joined = {end for edge in self.tree.joints for end in (edge.parent, edge.child)}
        self.scenery = frozenset(
            node.name
            for node in self.tree.links.values()
            if world.models[node.model].static and node.name not in joined
        )
        """Static links without joints: their shapes go to the world body, because MuJoCo tests every shape of any other
        body at every step.
        """
        parts = Counter(edge.child for edge in self.tree.loops)
        self.mass_ratio = {name: 1 / (1 + parts[name]) for name in self.tree.links}
        """Ratio of a body's mass to its link's: a link that closes a loop is split into equal parts."""
        self.bodies: dict[str, mujoco.MjsBody] = {}
        self.refused_moments: dict[str, list[float]] = {}
        """Body → moments of inertia that MuJoCo simulates, but does not compile."""
        self.shapes: list[ShapeEntry] = []
        self.shape_names: set[str] = set()

    def compile(self) -> CompiledWorld:
        """Fill the specification and compile it.

        Raises:
            DescriptionError: MuJoCo refuses the model.
        """
        pair_params, model = self.compile_model()
        return self.finish(model, pair_params)

    def compile_model(self) -> tuple[dict[tuple[str, str], ContactParams], mujoco.MjModel]:
        """Compile the specification; return the contact parameters of its shape pairs, and MuJoCo's model.

        Raises:
            DescriptionError: MuJoCo refuses the model.
        """
        pair_params = self.fill()
        reserve_tables(self.spec, self.batches.bodies, pair_params, self.shapes, self.world)
        model = self.compile_spec()
        for name, moments in self.refused_moments.items():
            model.body(name).inertia[:] = moments
        if self.refused_moments:
            set_constants(model)
        return pair_params, model

    def finish(
        self,
        model: mujoco.MjModel,
        pair_params: dict[tuple[str, str], ContactParams],
        *,
        world: World | None = None,
        shapes: Sequence[ShapeEntry] | None = None,
        like: CompiledWorld | None = None,
    ) -> CompiledWorld:
        """Complete MuJoCo's model with compliance and the tables of contact laws, and index it.

        Args:
            model: MuJoCo's compiled model.
            pair_params: contact parameters of its shape pairs.
            world: world with the new numbers; None: the compiler's own.
            shapes: shapes with the new surfaces; None: the compiler's own.
            like: compiled world with the same index; None: the index is built.
        """
        world, shapes = world or self.world, self.shapes if shapes is None else shapes
        choose_jacobian(model)
        contact_springs = set_compliance(model, pair_params)
        if like is None:
            collisions = {shape.name: shape.collision for shape in self.shapes}
            like = index_world(world, self.tree, self.joints.axes, collisions, model)
            start = initial_positions(model, self.tree, self.joints.axes, self.report)
            like = replace(like, initial_qpos=start)
        fill_tables(model, pair_params, shapes, like.link_bodies.tolist(), world, contact_springs)
        enable_ccd(model, shapes)
        return replace(like, world=world, model=model)

    @property
    def searches(self) -> bool:
        """True if the contacts of some shapes are found without pairs."""
        return any(shape.geom.contype or shape.geom.conaffinity for shape in self.shapes)

    def fill(self) -> dict[tuple[str, str], ContactParams]:
        """Add the world to the specification; return the contact parameters of its shape pairs."""
        for node in self.tree.links.values():
            self._add_link(node)
        for edge in self.tree.loops:
            self._close_loop(edge)
        collisions = (collision for node in self.tree.links.values() for collision in node.link.collisions)
        if self.cuts_meshes and any(isinstance(collision.geometry, MeshFile) for collision in collisions):
            from .mesh_shapes import cut_meshes  # worlds without meshes do not import the decomposition

            self.decomposition = cut_meshes(self.tree, self._cutting)
        for node in self.tree.links.values():
            for collision in node.link.collisions:
                self._add_collision(node, collision)
        self.batches.attach()
        pair_params = add_contacts(self.spec, self.shapes, self.world.models, self.tree, self.report)
        self.joints.couple_joints(self.tree)
        for axes in self.joints.axes.values():
            for axis in axes:
                if axis.axis is not None:
                    self._add_motor(axis.engine_joint)
        return pair_params

    def compile_spec(self) -> mujoco.MjModel:
        """Compile the specification; raise MuJoCo's errors and report its warnings."""
        self._set_memory()
        with native_output_hidden(), warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            ignore_attach_warning()
            try:
                compiled = self.spec.compile()
            except ValueError as error:
                problem = " ".join(str(error).split())
                raise DescriptionError(self.world.at, f"the engine cannot simulate this: {problem}", "engine") from None
        for warning in caught:
            self.report.warn(self.world.at, f"MuJoCo warns: {' '.join(str(warning.message).split())}", "engine")
        return compiled

    def _set_memory(self) -> None:
        """Size MuJoCo's arena for many bodies; the operating system provides only the pages in use.

        MuJoCo's default is too small for static bodies, and a terabyte for 13,000 bodies.
        """
        bodies = self.batches.bodies
        if len(bodies) < _MANY_BODIES:
            return
        moving = sum(1 for body in bodies if body.joints)
        self.spec.memory = _BASE_BYTES + _PAIR_BYTES * len(bodies) ** 2 // 2 + _MOVING_BYTES * moving
        if self.spec.memory > _LARGE_BYTES:
            size = f"{self.spec.memory / 1e9:.1f} GB"
            self.report.info(
                self.world.at, f"{len(bodies):,} bodies: the engine may use up to {size} of memory", "engine-memory"
            )

    def _add_link(self, node: LinkNode) -> None:
        """Add a link's body, after the bodies of its ancestors."""
        chain: list[LinkNode] = []
        current: LinkNode | None = node
        while current is not None and current.name not in self.bodies:
            chain.append(current)
            edge = self._parent_joint(current)
            current = None if edge is None or edge.parent == WORLD else self.tree.links[edge.parent]
        for member in reversed(chain):
            edge = self._parent_joint(member)
            body = self._add_body(member.name, member, edge)
            if edge is not None:
                self.joints.add(body, edge, member.world_from_link_at_zero)
            elif not member.fixed:
                body.add_freejoint(name=f"{member.name}::free")
            self.bodies[member.name] = body

    def _parent_joint(self, node: LinkNode) -> JointEdge | None:
        return None if node.fixed else self.tree.parent_joint.get(node.name)

    def _close_loop(self, edge: JointEdge) -> None:
        """Add part of a link as a body below its second parent."""
        node = self.tree.links[edge.child]
        part = f"{node.name} on {edge.name}"
        self.joints.add(self._add_body(part, node, edge), edge, node.world_from_link_at_zero)
        self.joints.weld(part, node.name, as_one=edge.parent_from_child is not None)
        self.report.info(
            edge.joint.at, f"joint {edge.joint.name!r} closes a loop of links; a constraint holds it", "loop-joint"
        )

    def _add_body(self, name: str, node: LinkNode, edge: JointEdge | None) -> mujoco.MjsBody:
        """Add a body for a link, or for a part of a split one, below the parent of `edge`."""
        link, ratio = node.link, self.mass_factor(node)
        parent, world_from_parent = None, Pose()
        if edge is not None and edge.parent != WORLD:
            parent, world_from_parent = self.bodies[edge.parent], self.tree.links[edge.parent].world_from_link
        parent_from_child = None if edge is None else edge.parent_from_child
        pose = world_from_parent.inverse() @ node.world_from_link if parent_from_child is None else parent_from_child
        body = self.batches.add_body(parent, name=name, pose=pose)
        if not node.fixed:
            mass, axes, moments = principal_inertia(link, self.report)
            possible = possible_moments(moments)
            if possible != moments:
                self.refused_moments[name] = [moment * ratio for moment in moments]
            body.mass, body.inertia, body.explicitinertial = mass * ratio, [m * ratio for m in possible], True
            body.ipos, body.iquat = axes.position, axes.quaternion
        if not link.gravity or link.kinematic:
            body.gravcomp = 1.0
        return body

    def mass_factor(self, node: LinkNode) -> float:
        """Return the factor from a link's mass to that of its body."""
        return self.mass_ratio[node.name] * (_KINEMATIC_MASS if node.link.kinematic else 1.0)

    def _add_collision(self, node: LinkNode, collision: Collision) -> None:
        fixed = node.name in self.tree.immobile
        body = self.bodies[node.name]
        if isinstance(collision.geometry, Plane | Heightmap) and not fixed:
            kind = "plane" if isinstance(collision.geometry, Plane) else "heightmap"
            self.report.warn(
                collision.at, f"collision {collision.name!r}: a {kind} cannot move; it is left out", "static-shape"
            )
            return
        if fixed and collision.surface.fdir1 != ZERO:
            note = "its <fdir1> does not count: as in Gazebo, the moving collision's does"
            self.report.info(collision.at, f"collision {collision.name!r}: {note}", "approximated-shape")
        name = self._shape_name(f"{node.name}::{collision.name}")
        parts = [(collision, name, CollidesWith.ALL, 1)]
        tread = tread_of(collision, node, self.tree)
        if tread is not None:
            on = CollidesWith.PLANES | CollidesWith.FIXED
            rolling = replace(collision, geometry=tread)
            parts = [
                (rolling, f"{name}::tread", on, TREAD_POINTS),
                (without_tread(collision), name, CollidesWith.ALL, 1),
            ]
        if node.name in self.scenery:
            body = self.spec.worldbody
            parts = [(_in_world(collision, node), name, CollidesWith.ALL, 1)]
        for part, part_name, on, points in parts:
            for geom, meets in add_shape(
                self.spec, body, part, part_name, self.report, fixed=fixed, decomposition=self.decomposition
            ):
                has_tread = tread is not None and points != TREAD_POINTS
                self._add_shape_entry(geom, node, collision, meets & on, points, has_tread=has_tread)

    def _add_shape_entry(
        self,
        geom: mujoco.MjsGeom,
        node: LinkNode,
        collision: Collision,
        meets: CollidesWith,
        points: int,
        *,
        has_tread: bool,
    ) -> None:
        self.shapes.append(
            ShapeEntry(
                geom,
                geom.name,
                collision=f"{node.name}::{collision.name}",
                model=node.model,
                link=node.name,
                fixed=node.name in self.tree.immobile,
                surface=collision.surface,
                collides_with=meets,
                points=points,
                has_tread=has_tread,
            )
        )

    def _shape_name(self, name: str) -> str:
        """Return a unique name: collisions of one link may share a name."""
        unique, number = name, 2
        while unique in self.shape_names:
            unique, number = f"{name}#{number}", number + 1
        self.shape_names.add(unique)
        return unique

    def _add_motor(self, joint: str) -> None:
        """Add an actuator with zero gains, which is inactive until commanded."""
        motor = self.spec.add_actuator(name=joint, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        motor.gaintype = mujoco.mjtGain.mjGAIN_FIXED
        motor.biastype = mujoco.mjtBias.mjBIAS_AFFINE
        motor.gainprm = [0.0] * len(motor.gainprm)
        motor.biasprm = [0.0] * len(motor.biasprm)
        motor.forcelimited = mujoco.mjtLimited.mjLIMITED_TRUE
        motor.forcerange = [-1.0, 1.0]
        motor.ctrllimited = mujoco.mjtLimited.mjLIMITED_FALSE


def _in_world(collision: Collision, node: LinkNode) -> Collision:
    """Return the collision posed in the world."""
    return replace(collision, link_from_collision=node.world_from_link @ collision.link_from_collision)

"""Builder of a link: shapes, sensors and mass."""

from typing import TYPE_CHECKING, Self

from trundle.base.arguments import pose_of, vector_of
from trundle.base.diagnostics import UsageError
from trundle.base.documented import documented
from trundle.robots import model
from trundle.robots.model import Collision, Inertial, Sensor, Visual
from trundle.spatial import Pose

from ..inertia_sum import rotate_inertia, sum_inertias
from .names import BUILT, check_name, check_positive
from .sensors import SensorSettings, make_sensor
from .shapes import Shape, ShapeAdder

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from trundle.base.arguments import PoseLike

_ORIGIN = Pose()


@documented("add_box add_sphere add_cylinder add_capsule add_mesh add_sensor set_inertial")
class Link(ShapeAdder["Link"]):
    """Rigid body with the mass properties of its shapes, or of `set_inertial`.

    Without either, SDF's defaults apply: 1 kg and 1 kg·m². Poses of shapes and sensors are in the link frame.
    """

    __module__ = "trundle"

    def __init__(self, name: str, pose: Pose) -> None:
        """Create an empty link; called by `Model.add_link`."""
        self.name = name
        self.pose = pose
        """Pose in the model's frame."""
        self._shapes: list[Shape] = []
        self._sensors: list[Sensor] = []
        self._inertial: Inertial | None = None

    def set_inertial(
        self,
        mass: float,
        moments: "ArrayLike",
        *,
        products: "ArrayLike" = (0.0, 0.0, 0.0),
        center: "ArrayLike" = (0.0, 0.0, 0.0),
    ) -> Self:
        """Set the mass properties, in place of those of the shapes.

        Args:
            mass: [kg]
            moments: ixx, iyy, izz about the centre of mass, along the link's axes [kg·m²].
            products: ixy, ixz, iyz [kg·m²].
            center: centre of mass in the link's frame [m].

        Raises:
            UsageError: the mass or a moment is not above zero.
        """
        ixx, iyy, izz = vector_of(moments, "moments [kg·m²]")
        check_positive(f"mass and moments of link {self.name!r}", mass, ixx, iyy, izz)
        self._inertial = Inertial(
            mass=mass,
            link_from_com=Pose(vector_of(center, "center [m]")),
            moments=(ixx, iyy, izz),
            products=vector_of(products, "products [kg·m²]"),
        )
        return self

    def add_sensor(
        self,
        name: str,
        type: str,
        settings: SensorSettings | None = None,
        *,
        pose: "PoseLike" = _ORIGIN,
        update_rate: float = 0.0,
        always_on: bool = False,
        visualize: bool = False,
        topic: str = "",
    ) -> Self:
        """Mount a sensor.

        Args:
            name: sensor's name.
            type: SDF's: camera, depth_camera, ray, imu, contact, gps, altimeter, …
            settings: struct of that type: `CameraOptics`, `RangeScan`, `ImuNoise`, …; None: SDF's defaults.
            pose: pose in the link frame: `Pose`, or 3, 6 or 7 numbers.
            update_rate: [Hz]; 0: at every step.
            always_on: keep the update schedule without subscribers.
            visualize: show its rays.
            topic: topic name; empty: Gazebo's default.

        Raises:
            UsageError: unknown type, settings of another type, or a duplicate name.
        """
        check_name(name, self._sensors, f"link {self.name!r}")
        if type == "force_torque":
            raise UsageError(f"sensor {name!r}: force_torque sensors sit on joints; add it to one")
        self._sensors.append(
            make_sensor(
                name,
                type,
                settings,
                pose=pose_of(pose),
                update_rate=update_rate,
                always_on=always_on,
                visualize=visualize,
                topic=topic,
            )
        )
        return self

    def add_shape(self, shape: Shape) -> "Link":
        """Add a shape to the link."""
        check_name(shape.name, self._shapes, f"link {self.name!r}")
        self._shapes.append(shape)
        return self

    def description(self) -> model.Link:
        """Return the link as a reader would."""
        return model.Link(
            name=self.name,
            at=BUILT,
            model_from_link=self.pose,
            inertial=self._inertial or self._inertial_of_shapes(),
            visuals=tuple(
                Visual(name=s.name, geometry=s.geometry, at=BUILT, link_from_visual=s.pose, material=s.material)
                for s in self._shapes
                if s.visual
            ),
            collisions=tuple(
                Collision(name=s.name, geometry=s.geometry, at=BUILT, link_from_collision=s.pose, surface=s.surface)
                for s in self._shapes
                if s.collision
            ),
            sensors=tuple(self._sensors),
        )

    def _inertial_of_shapes(self) -> Inertial:
        if not self._shapes:
            return Inertial()
        mass, center, (xx, yy, zz, xy, xz, yz) = sum_inertias(
            [
                (s.mass, s.pose.transform_point(s.center), rotate_inertia(s.inertia, s.pose.quaternion))
                for s in self._shapes
            ]
        )
        return Inertial(mass=mass, link_from_com=Pose(center), moments=(xx, yy, zz), products=(xy, xz, yz))

    def __repr__(self) -> str:
        shapes, sensors = (", ".join(repr(part.name) for part in group) for group in (self._shapes, self._sensors))
        return f"<Link {self.name!r}; shapes: {shapes or 'none'}; sensors: {sensors or 'none'}>"

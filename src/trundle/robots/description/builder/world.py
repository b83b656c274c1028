"""Builder of a world: models and lights."""

from pathlib import Path
from typing import TYPE_CHECKING

from msgspec.structs import replace

from trundle.base.arguments import pose_of, vector_of
from trundle.base.diagnostics import UsageError
from trundle.base.documented import documented
from trundle.robots import model
from trundle.robots.model import Collision, Light, LightType, PhysicsSettings, Plane, Rgba, Visual
from trundle.spatial import Pose, Vector3, normalized

from .model import Model
from .names import BUILT, check_name, check_positive, color_of
from .shapes import Shape, ShapeAdder
from .writing import save, sdf_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from trundle.base.arguments import PoseLike

_OVERHEAD = Pose((0.0, 0.0, 10.0))
_UP: Vector3 = (0.0, 0.0, 1.0)


@documented("add_model add_ground_plane add_light add_box add_sphere add_cylinder add_capsule add_mesh to_sdf save")
class World(ShapeAdder[Model]):
    """World, initially empty and without lights, like SDF's.

    A shape added to the world becomes a model with one link, "link", at the shape's pose.
    """

    __module__ = "trundle"

    def __init__(
        self, name: str = "default", *, gravity: "ArrayLike" = (0.0, 0.0, -9.8), max_step_size: float = 0.001
    ) -> None:
        """Create an empty world.

        Args:
            name: world's name.
            gravity: (3) [m/s²]
            max_step_size: time step [s].

        Raises:
            UsageError: the time step is not above zero.
        """
        check_positive("max_step_size", max_step_size)
        self.name = check_name(name, (), "a world")
        self._physics = PhysicsSettings(gravity=vector_of(gravity, "gravity [m/s²]"), max_step_size_s=max_step_size)
        self._models: list[Model] = []
        self._lights: list[Light] = []
        self._has_ground = False

    def add_model(self, model: Model | str, *, pose: "PoseLike | None" = None) -> Model:
        """Add a model, or an empty one of that name, and return it.

        Args:
            model: model or name.
            pose: pose in the world [m, rad]: `Pose`, or 3, 6 or 7 numbers; None: the model's own.

        Raises:
            UsageError: duplicate name; the message lists the names in use.
        """
        new_model = Model(model) if isinstance(model, str) else model
        existing = [*self._models, *([Model(_GROUND)] if self._has_ground else [])]
        check_name(new_model.name, existing, f"world {self.name!r}")
        if pose is not None:
            new_model.pose = pose_of(pose)
        self._models.append(new_model)
        return new_model

    def add_ground_plane(self) -> None:
        """Add Gazebo's ground_plane: infinite at z = 0, drawn 100 m wide.

        Raises:
            UsageError: the world has a model of that name.
        """
        check_name(_GROUND, self._models, f"world {self.name!r}")
        self._has_ground = True

    def add_light(
        self,
        name: str = "sun",
        type: LightType = "directional",
        *,
        pose: "PoseLike" = _OVERHEAD,
        direction: "ArrayLike" = (-0.5, 0.1, -0.9),
        diffuse: Rgba = (0.8, 0.8, 0.8, 1.0),
        specular: Rgba = (0.2, 0.2, 0.2, 1.0),
        cast_shadows: bool = True,
    ) -> None:
        """Add a light; the defaults are those of Gazebo's sun.

        Args:
            name: light's name.
            type: directional, point or spot.
            pose: pose in the world: `Pose`, or 3, 6 or 7 numbers.
            direction: direction of the light rays in the light's frame (3).
            diffuse: diffuse color: red, green, blue, each 0 to 1, and opacity if there are 4.
            specular: color of highlights.
            cast_shadows: True if it casts shadows.

        Raises:
            UsageError: duplicate name, or a direction of zero length.
        """
        check_name(name, self._lights, f"world {self.name!r}")
        unit = normalized(vector_of(direction, "direction"))
        if unit is None:
            raise UsageError(f"light {name!r}: {direction} is no direction")
        self._lights.append(
            Light(
                name=name,
                type=type,
                at=BUILT,
                world_from_light=pose_of(pose),
                direction=unit,
                diffuse=color_of(diffuse, "diffuse"),
                specular=color_of(specular, "specular"),
                cast_shadows=cast_shadows,
            )
        )

    def add_shape(self, shape: Shape) -> Model:
        """Add a shape as a model of one link."""
        new_model = self.add_model(shape.name, pose=shape.pose)
        new_model.add_link("link").add_shape(replace(shape, pose=Pose()))
        return new_model

    def description(self) -> model.World:
        """Return the world as a reader would."""
        ground = (_ground_plane(),) if self._has_ground else ()
        return model.World(
            name=self.name,
            at=BUILT,
            models=(*ground, *(built_model.description() for built_model in self._models)),
            lights=tuple(self._lights),
            physics=self._physics,
        )

    def to_sdf(self) -> str:
        """Return the world as an SDF document."""
        return sdf_of(self.description(), is_world=True)

    def save(self, file: str | Path) -> None:
        """Write the world as an SDF file.

        Raises:
            UsageError: it cannot be written.
        """
        save(self.to_sdf(), file)

    def __repr__(self) -> str:
        models, lights = (", ".join(repr(part.name) for part in group) for group in (self._models, self._lights))
        return f"<World {self.name!r}; models: {models or 'none'}; lights: {lights or 'none'}>"


_GROUND = "ground_plane"


def _ground_plane() -> model.Model:
    plane = Plane(_UP, (100.0, 100.0))
    link = model.Link(
        name="link",
        at=BUILT,
        visuals=(Visual(name="visual", geometry=plane, at=BUILT),),
        collisions=(Collision(name="collision", geometry=plane, at=BUILT),),
    )
    return model.Model(name=_GROUND, at=BUILT, static=True, links=(link,), canonical_link="link")

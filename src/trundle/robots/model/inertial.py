"""Mass properties of a link.

SDF and URDF <inertial> both end here; only `physics` reads it.
"""

from msgspec import Struct

from trundle.spatial import Pose


class Inertial(Struct, frozen=True, kw_only=True):
    """Mass, centre of mass and rotational inertia of one link."""

    mass: float = 1.0
    """[kg], as written."""
    link_from_com: Pose = Pose()
    """Inertia frame in the link frame [m]; its origin is the centre of mass."""
    moments: tuple[float, float, float] = (1.0, 1.0, 1.0)
    """ixx, iyy, izz about the centre of mass, in the inertia frame [kg·m²]."""
    products: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """ixy, ixz, iyz about the centre of mass, in the inertia frame [kg·m²]."""

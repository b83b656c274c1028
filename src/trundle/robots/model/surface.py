"""Contact parameters of collisions."""

from msgspec import Struct

from trundle.spatial import ZERO, Vector3


class Surface(Struct, frozen=True, kw_only=True):
    """Contact parameters of one collision, in SDF's terms, with the defaults of SDF 1.4 and later."""

    __module__ = "trundle"

    mu: float = 1.0
    """Coulomb friction along the first friction direction; < 0 stands for infinite."""
    mu2: float = 1.0
    """Coulomb friction along the second friction direction."""
    fdir1: Vector3 = ZERO
    """First friction direction in the collision's frame; zero: chosen by the engine."""
    slip1: float = 0.0
    """Slip compliance: speed along the first friction direction per force along it, without sliding [m/s/N]."""
    slip2: float = 0.0
    """Slip compliance along the second friction direction [m/s/N]."""
    torsional_coefficient: float = 1.0
    """Torsional friction coefficient, for a contact patch of `patch_radius` or `surface_radius`."""
    torsional_slip: float = 0.0
    """Torsional slip compliance: speed about the normal per torque about it [rad/s/(N·m)]."""
    patch_radius: float = 0.0
    """Radius of the contact patch [m]; 0: none."""
    surface_radius: float = 0.0
    """Radius of curvature that gives the patch size [m]; 0: none."""
    use_patch_radius: bool = True
    """`patch_radius` is used where both surfaces set this, else `surface_radius`."""
    kp: float = 1e12
    """Contact stiffness [N/m]."""
    kd: float = 1.0
    """Contact damping [N·s/m]."""
    min_depth: float = 0.0
    """Penetration depth without correction [m]."""
    max_vel: float = 0.01
    """Largest correcting velocity [m/s]."""
    restitution: float = 0.0
    """0 to 1; applied when the closing speed exceeds `bounce_threshold`."""
    bounce_threshold: float = 100000.0
    """[m/s]"""
    collide_bitmask: int = 0xFFFF
    category_bitmask: int | None = None
    """As written; Gazebo 11 filters collisions by collide_bitmask alone."""
    collide_without_contact: bool = False

"""What a collision is like to touch."""

from msgspec import Struct

from trundle.spatial import ZERO, Vector3


class Surface(Struct, frozen=True, kw_only=True):
    """Contact parameters of one collision, in SDF's terms; defaults are SDF 1.4's and later."""

    mu: float = 1.0
    """Coulomb friction along the first friction direction; < 0 stands for infinite."""
    mu2: float = 1.0
    """Along the second."""
    fdir1: Vector3 = ZERO
    """First friction direction in the collision's frame; zero: left to the engine."""
    slip1: float = 0.0
    """[m/s/N] Speed along the first friction direction that a force along it causes, without sliding."""
    slip2: float = 0.0
    """Along the second."""
    torsional_coefficient: float = 1.0
    """Friction against turning on the spot, for a patch of contact as large as the next two say."""
    torsional_slip: float = 0.0
    """[rad/s/(N·m)] Speed about the normal that a torque about it causes."""
    patch_radius: float = 0.0
    """Of the patch [m]; 0: none."""
    surface_radius: float = 0.0
    """Curvature [m] that the patch grows from; 0: none."""
    use_patch_radius: bool = True
    """Where both of two surfaces want it, `patch_radius` counts, else `surface_radius`."""
    kp: float = 1e12
    """Contact stiffness [N/m]."""
    kd: float = 1.0
    """Contact damping [N·s/m]."""
    min_depth: float = 0.0
    """Depth before a correcting impulse [m]."""
    max_vel: float = 0.01
    """Largest correcting velocity [m/s]."""
    restitution: float = 0.0
    """0 to 1; applied when the approach is faster than `bounce_threshold`."""
    bounce_threshold: float = 100000.0
    """[m/s]"""
    collide_bitmask: int = 0xFFFF
    category_bitmask: int | None = None
    """As written; Gazebo 11 lets two collisions meet by their collide_bitmasks alone."""
    collide_without_contact: bool = False

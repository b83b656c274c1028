"""ODE's settings, which scripts read and write back; MuJoCo has no equivalents."""

from trundle.ros import Message, Option

Setting = bool | int | float

_MAX_VALUE = 10_000_000
_SETTINGS: tuple[tuple[str, Setting, float, str], ...] = (
    ("auto_disable_bodies", False, 1, "Disable bodies at rest"),
    ("sor_pgs_precon_iters", 0, 10_000, "Preconditioning iterations of the solver"),
    ("sor_pgs_iters", 50, 10_000, "Iterations of the solver"),
    ("sor_pgs_rms_error_tol", 0.0, 10_000, "Error at which the solver stops"),
    ("sor_pgs_w", 1.3, 5, "Relaxation of the solver"),
    ("cfm", 0.0, 10, "Constraint force mixing"),
    ("erp", 0.2, 10, "Error reduction"),
    ("contact_surface_layer", 0.001, 10, "Depth of contact without force [m]"),
    ("contact_max_correcting_vel", 100.0, _MAX_VALUE, "Maximum correcting velocity of contacts [m/s]"),
    ("max_contacts", 20, _MAX_VALUE, "Contacts between two bodies"),
)
"""Name, Gazebo's default, maximum in gazebo_ros' cfg/Physics.cfg, description."""
IGNORED = "without effect here, where MuJoCo is the engine: "


class OdeSettings:
    """Values last set by any service."""

    def __init__(self) -> None:
        self.values: dict[str, Setting] = {name: value for name, value, _, _ in _SETTINGS}

    def update_config(self, config: Message) -> list[str]:
        """Store the values of a gazebo_msgs/ODEPhysics; returns the names of changed settings."""
        return self.update({name: getattr(config, name) for name in self.values})

    def update(self, values: dict[str, Setting]) -> list[str]:
        """Store values; returns the names of changed settings."""
        changed = [name for name, value in values.items() if value != self.values[name]]
        self.values.update(values)
        return changed

    def options(self) -> list[Option]:
        """Settings as dynamic_reconfigure options."""
        return [
            Option(name=name, value=value, lower=-1.0 if name == "sor_pgs_rms_error_tol" else 0.0, upper=upper,
                   description=f"{text}; kept, but {IGNORED.rstrip(': ')}")
            for name, value, upper, text in _SETTINGS
        ]  # fmt: skip

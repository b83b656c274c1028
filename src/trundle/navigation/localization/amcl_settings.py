"""amcl's parameters, with the original's names and defaults."""

import math
from collections.abc import Callable, Sequence

from msgspec import Struct, structs

from trundle.base.built import refuse_stale
from trundle.robots.parameters import RosParameters
from trundle.ros import Option, Options

from . import _localization

refuse_stale(_localization)
LASER_MODELS = ("beam", "likelihood_field", "likelihood_field_prob")
ODOMETRY_MODELS = ("diff", "omni", "diff-corrected", "omni-corrected")


class AmclSettings(Struct, frozen=True, kw_only=True):
    """Parameters in the order of dynamic_reconfigure; lengths [m], angles [rad], rates [Hz]."""

    min_particles: int = 100
    max_particles: int = 5000
    kld_err: float = 0.01
    kld_z: float = 0.99
    update_min_d: float = 0.2
    update_min_a: float = math.pi / 6.0
    resample_interval: int = 2
    transform_tolerance: float = 0.1
    recovery_alpha_slow: float = 0.001
    recovery_alpha_fast: float = 0.1
    do_beamskip: bool = False
    beam_skip_distance: float = 0.5
    beam_skip_threshold: float = 0.3
    tf_broadcast: bool = True
    force_update_after_initialpose: bool = False
    force_update_after_set_map: bool = False
    gui_publish_rate: float = -1.0
    save_pose_rate: float = 0.5
    use_map_topic: bool = False
    first_map_only: bool = False
    laser_min_range: float = -1.0
    laser_max_range: float = -1.0
    laser_max_beams: int = 30
    laser_z_hit: float = 0.95
    laser_z_short: float = 0.1
    laser_z_max: float = 0.05
    laser_z_rand: float = 0.05
    laser_sigma_hit: float = 0.2
    laser_lambda_short: float = 0.1
    laser_likelihood_max_dist: float = 2.0
    laser_model_type: str = "likelihood_field"
    odom_model_type: str = "diff"
    odom_alpha1: float = 0.2
    odom_alpha2: float = 0.2
    odom_alpha3: float = 0.2
    odom_alpha4: float = 0.2
    odom_alpha5: float = 0.2
    odom_frame_id: str = "odom"
    base_frame_id: str = "base_link"
    global_frame_id: str = "map"
    beam_skip_error_threshold: float = 0.9
    selective_resampling: bool = False

    @property
    def filter_options(self) -> _localization.FilterOptions:
        """Options of the particle filter."""
        return _localization.FilterOptions(
            min_particles=min(self.min_particles, self.max_particles),
            max_particles=max(self.max_particles, 1),
            kld_err=max(self.kld_err, _MIN_KLD_ERR),
            kld_z=self.kld_z,
            alpha_slow=self.recovery_alpha_slow,
            alpha_fast=self.recovery_alpha_fast,
            selective_resampling=self.selective_resampling,
        )

    @property
    def laser_options(self) -> _localization.LaserOptions:
        """Options of the laser's model."""
        options = _localization.LaserOptions()
        options.kind = LASER_MODELS.index(self.laser_model_type)
        options.max_beams = self.laser_max_beams
        options.z_hit, options.z_short = self.laser_z_hit, self.laser_z_short
        options.z_max, options.z_rand = self.laser_z_max, self.laser_z_rand
        options.sigma_hit, options.lambda_short = max(self.laser_sigma_hit, _MIN_SIGMA_M), self.laser_lambda_short
        options.max_distance = self.laser_likelihood_max_dist
        options.do_beamskip, options.beam_skip_distance = self.do_beamskip, self.beam_skip_distance
        options.beam_skip_threshold = self.beam_skip_threshold
        options.beam_skip_error_threshold = self.beam_skip_error_threshold
        return options

    @property
    def odometry_model(self) -> _localization.OdometryModel:
        """Noise of the odometry."""
        alphas = (self.odom_alpha1, self.odom_alpha2, self.odom_alpha3, self.odom_alpha4, self.odom_alpha5)
        return _localization.OdometryModel(ODOMETRY_MODELS.index(self.odom_model_type), alphas)


_MIN_KLD_ERR = 1e-6
_MIN_SIGMA_M = 1e-6
_BOUNDS: dict[str, tuple[float, float]] = {
    "min_particles": (0, 1000),
    "max_particles": (0, 10000),
    "kld_err": (0, 1),
    "kld_z": (0, 1),
    "update_min_d": (0, 5),
    "update_min_a": (0, 2 * math.pi),
    "resample_interval": (0, 20),
    "transform_tolerance": (0, 2),
    "recovery_alpha_slow": (0, 0.5),
    "recovery_alpha_fast": (0, 1),
    "beam_skip_distance": (0, 2),
    "beam_skip_threshold": (0, 1),
    "gui_publish_rate": (-1, 100),
    "save_pose_rate": (-1, 10),
    "laser_min_range": (-1, 1000),
    "laser_max_range": (-1, 1000),
    "laser_max_beams": (0, 250),
    "laser_z_hit": (0, 1),
    "laser_z_short": (0, 1),
    "laser_z_max": (0, 1),
    "laser_z_rand": (0, 1),
    "laser_sigma_hit": (0, 10),
    "laser_lambda_short": (0, 10),
    "laser_likelihood_max_dist": (0, 20),
    **{f"odom_alpha{number}": (0, 10) for number in range(1, 6)},
}
"""Bounds of AMCL.cfg, for dynamic_reconfigure; parameters themselves may lie outside."""
_NOT_RECONFIGURED = ("beam_skip_error_threshold", "selective_resampling")
_MAX_PARTICLES = 1_000_000
_DEFAULTS = AmclSettings()


def read_settings(parameters: RosParameters, warn: Callable[[str], None]) -> AmclSettings:
    """Read amcl's private parameters; unknown models become the defaults.

    Args:
        parameters: private parameters.
        warn: called with each warning.

    Raises:
        ParamError: a parameter has the wrong type.
    """
    values: Options = {}
    for name, default in structs.asdict(_DEFAULTS).items():
        match default:
            case bool():
                values[name] = parameters.flag(name, default=default)
            case int():
                values[name] = parameters.integer(name, default)
            case float():
                values[name] = parameters.number(name, default)
            case _:
                values[name] = parameters.text(name, default)
    return settings_from(values, warn)


def settings_from(values: Options, warn: Callable[[str], None]) -> AmclSettings:
    """Return the settings of a node's options; warn of unknown models."""
    models: Sequence[tuple[str, Sequence[str]]] = (
        ("laser_model_type", LASER_MODELS),
        ("odom_model_type", ODOMETRY_MODELS),
    )
    for name, known in models:
        if values[name] not in known:
            default = str(getattr(_DEFAULTS, name))
            warn(f"no {name} {values[name]!r}; there are: {', '.join(known)}; {default} is used")
            values[name] = default
    if int(values["max_particles"]) > _MAX_PARTICLES:
        warn(f"max_particles {values['max_particles']} exceeds {_MAX_PARTICLES}, which is used")
        values["max_particles"] = _MAX_PARTICLES
    for name in ("odom_frame_id", "base_frame_id", "global_frame_id"):
        values[name] = str(values[name]).lstrip("/")
    return AmclSettings(**values)  # pyright: ignore[reportArgumentType]  # each of its default's type


def reconfigure_options(settings: AmclSettings) -> list[Option]:
    """Return the options of AMCL.cfg with their present values."""
    options = [
        Option(name=name, value=value, lower=bounds[0], upper=bounds[1])
        for name, value in structs.asdict(settings).items()
        if name not in _NOT_RECONFIGURED
        for bounds in [_BOUNDS.get(name, (-math.inf, math.inf))]
    ]
    return [*options, Option(name="restore_defaults", value=False)]

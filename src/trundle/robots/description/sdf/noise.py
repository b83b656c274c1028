"""Reader of <noise>."""

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Noise

from .context import Context

_MAX_PARAMETER = 1e15
"""Maximum of any noise parameter, in its unit."""
_TYPES = ("gaussian", "gaussian_quantized", "custom", "none")


def read_noise(node: XmlNode | None, context: Context) -> Noise:
    """Read Gaussian noise; a custom one is added by a plugin; other types are no noise, with a warning."""
    if node is None:
        return Noise()
    report = context.report
    type_ = node.attribute("type") or node.string("type") or "gaussian"
    if type_ not in _TYPES:
        report.warn(
            node.at, f"no noise type {type_!r}: {', '.join(_TYPES)}; none is used, as in Gazebo", "unknown-choice"
        )
        return Noise()
    if type_ in ("none", "custom"):
        return Noise()
    noise = Noise(
        mean=_number(node, "mean", context),
        stddev=abs(_number(node, "stddev", context)),
        bias_mean=_number(node, "bias_mean", context),
        bias_stddev=abs(_number(node, "bias_stddev", context)),
        wander_density=max(0.0, _number(node, "dynamic_bias_stddev", context)),
        wander_time_s=max(0.0, _number(node, "dynamic_bias_correlation_time", context)),
        precision=_precision(node, context),
    )
    node.report_unread(report)
    return noise


def _number(node: XmlNode, tag: str, context: Context) -> float:
    value = node.number(tag, default=0.0)
    if abs(value) <= _MAX_PARAMETER:
        return value
    context.report.warn(node.at, f"noise with a {tag} of {value:g} is not possible; 0 is used", "out-of-range")
    return 0.0


def _precision(node: XmlNode, context: Context) -> float:
    precision = node.number("precision", default=0.0)
    if precision == 0.0 or 1.0 / _MAX_PARAMETER <= precision <= _MAX_PARAMETER:
        return precision
    context.report.warn(
        node.at, f"a precision of {precision:g} is not possible; values are not rounded", "out-of-range"
    )
    return 0.0

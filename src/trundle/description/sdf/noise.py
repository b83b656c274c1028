"""Reads <noise>."""

from trundle.model import Noise
from trundle.xmlnode import XmlNode

from .context import Context

_TYPES = ("gaussian", "gaussian_quantized", "none")


def read_noise(node: XmlNode | None, context: Context) -> Noise:
    """Gaussian noise; every other type is none."""
    if node is None:
        return Noise()
    report = context.report
    type_ = node.attribute("type") or node.string("type") or "gaussian"
    if type_ not in _TYPES:
        report.warn(node.at, f"no noise type {type_!r}: {', '.join(_TYPES)}; none is used, as in Gazebo")
        return Noise()
    if type_ == "none":
        return Noise()
    noise = Noise(
        mean=node.number("mean", default=0.0, report=report),
        stddev=abs(node.number("stddev", default=0.0, report=report)),
        bias_mean=node.number("bias_mean", default=0.0, report=report),
        bias_stddev=abs(node.number("bias_stddev", default=0.0, report=report)),
        wander_density=max(0.0, node.number("dynamic_bias_stddev", default=0.0, report=report)),
        wander_time_s=max(0.0, node.number("dynamic_bias_correlation_time", default=0.0, report=report)),
        precision=_precision(node, context),
    )
    node.report_unread(report)
    return noise


def _precision(node: XmlNode, context: Context) -> float:
    precision = node.number("precision", default=0.0, report=context.report)
    if precision >= 0.0:
        return precision
    context.report.warn(node.at, f"a precision of {precision:g} is not possible; values are not rounded")
    return 0.0

"""Names of models, links and joints that ROS does not allow."""

from collections.abc import Iterator

from trundle.base.diagnostics import Diagnostics, Source
from trundle.robots.model import Model, World
from trundle.robots.names import is_legal_base_name, ros_name


def report_ros_names(flat: World, report: Diagnostics) -> None:
    """Report each illegal name of what moves, with the name that the graph and tf have for it."""
    for model in flat.models:
        if model.static:
            continue
        for name, at in _names(model):
            if not is_legal_base_name(name.replace("::", "_")):
                report.info(at, f"{name!r} is not a legal ROS name; on the graph and in tf it is {ros_name(name)!r}")


def _names(model: Model) -> Iterator[tuple[str, Source]]:
    yield model.name, model.at
    for each in (*model.links, *model.joints):
        yield each.name, each.at

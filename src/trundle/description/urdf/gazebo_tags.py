"""<gazebo> blocks: what a URDF says to Gazebo alone."""

from trundle.model import Material, PluginTag, Sensor, Surface
from trundle.xmlnode import XmlNode

from ..sdf.context import Context
from ..sdf.frames import MODEL, FrameGraph
from ..sdf.material import named_material
from ..sdf.sensor import read_plugin, read_sensor

_TRUE = frozenset({"true", "yes", "1"})


class GazeboTags:
    """The blocks of one URDF, by what they refer to."""

    def __init__(self, root: XmlNode, context: Context) -> None:
        self._context = context
        self._blocks: dict[str, list[XmlNode]] = {}
        for block in root.all("gazebo"):
            self._blocks.setdefault(block.attribute("reference") or "", []).append(block)

    def flag(self, reference: str, tag: str) -> bool | None:
        """A yes or no; None where no block says."""
        node = self._last(reference, tag)
        return None if node is None else node.text.lower() in _TRUE

    def material(self, link: str) -> Material | None:
        """<material>Gazebo/Blue</material>"""
        node = self._last(link, "material")
        if node is None or not node.text:
            return None
        return named_material(node.text, node, self._context)

    def surface(self, link: str) -> Surface:
        """mu1, mu2, kp, kd, minDepth, maxVel."""
        default = Surface()

        def number(tag: str, otherwise: float) -> float:
            node = self._last(link, tag)
            return otherwise if node is None else node.as_number(default=otherwise, report=self._context.report)

        return Surface(
            mu=number("mu1", default.mu),
            mu2=number("mu2", default.mu2),
            kp=number("kp", default.kp),
            kd=number("kd", default.kd),
            min_depth=number("minDepth", default.min_depth),
            max_vel=number("maxVel", default.max_vel),
        )

    def sensors(self, link: str) -> tuple[Sensor, ...]:
        """<sensor> elements, which are SDF."""
        return tuple(
            read_sensor(node, link, FrameGraph(MODEL, self._context.report), self._context)
            for node in self._all(link, "sensor")
        )

    def plugins(self, reference: str) -> tuple[PluginTag, ...]:
        """<plugin> elements."""
        return tuple(read_plugin(node) for node in self._all(reference, "plugin"))

    def report_unread(self) -> None:
        """Name what nobody asked for."""
        for reference, blocks in self._blocks.items():
            for block in blocks:
                for node in block.unread():
                    whom = f"{reference!r}" if reference else "the robot"
                    self._context.report.warn(
                        node.at, f"<{node.tag}> for {whom} in <gazebo> is not supported; it is ignored"
                    )

    def _all(self, reference: str, tag: str) -> list[XmlNode]:
        return [node for block in self._blocks.get(reference, []) for node in block.all(tag)]

    def _last(self, reference: str, tag: str) -> XmlNode | None:
        found = self._all(reference, tag)
        return found[-1] if found else None

"""<gazebo> blocks of a URDF.

SDF readers are imported only for robots that need them.
"""

from collections.abc import Collection
from typing import TYPE_CHECKING

from msgspec.structs import replace

from trundle.base.diagnostics import DescriptionError
from trundle.base.xmlnode import XmlNode

from ..sdf.context import Context
from ..sdf.frames import MODEL, FrameGraph
from ..sdf.required import name_missing_attributes
from .contact_tags import CONTACT_TAGS, last_value, with_contact_tags
from .lump import Lump

if TYPE_CHECKING:
    from trundle.robots.model import Collision, Joint, Light, Link, Material, Model, PluginTag, Sensor, Visual

    from ..sdf.unplaced_model import UnplacedModel

_SLIPS = ("slip1", "slip2")
"""Parameters of a <surface> that sdformat's parser_urdf.cc does not read from <gazebo> (9.7 to 9.9 copy them into the
link, where nothing reads them).
"""
_TUNING = frozenset(
    {
        "stopCfm",
        "stopErp",
        "stopKp",
        "stopKd",
        "fudgeFactor",
        "implicitSpringDamper",
        "cfmDamping",
        "maxContacts",
        "canonicalBody",
    }
)
_IGNORED = "provideFeedback"
"""Ignored tag: joint reactions are always available."""
_TRUE = frozenset({"true", "yes", "1"})


class GazeboTags:
    """<gazebo> blocks of one URDF, by reference."""

    def __init__(self, root: XmlNode, context: Context) -> None:
        self._context = context
        self._blocks: dict[str, list[XmlNode]] = {}
        self._nodes: dict[tuple[str, str], list[XmlNode]] = {}
        """(reference, tag) → elements."""
        self._read: set[tuple[str, str]] = set()
        for block in root.all("gazebo"):
            reference = block.attribute("reference") or ""
            self._blocks.setdefault(reference, []).append(block)
            name_missing_attributes(block, context.version, context.report)
            for node in block.children:
                self._nodes.setdefault((reference, node.tag), []).append(node)

    def flag(self, reference: str, *tags: str) -> bool | None:
        """Return a boolean by any of its tags; None if no block has it."""
        nodes = [node for tag in tags if (node := self._last(reference, tag)) is not None]
        return nodes[0].text.lower() in _TRUE if nodes else None

    def lumped_flag(self, lump: Lump, *tags: str) -> bool | None:
        """Return `flag` over all links of a lump; the last one that is set wins (sdformat's AddKeyValue)."""
        values = [value for name, _ in lump.parts if (value := self.flag(name, *tags)) is not None]
        return values[-1] if values else None

    def material(self, link: str) -> "Material | None":
        """Return <material>Gazebo/Blue</material>, or a <visual> block's <material>, which applies to every visual."""
        blocks = [block for block in self._all(link, "visual") if block.find("material") is not None]
        if blocks:
            from ..sdf.material import read_material

            return read_material(blocks[-1], self._context)
        node = self._last(link, "material")
        if node is None or not node.text:
            return None
        from ..sdf.material import named_material

        return named_material(node.text, node, self._context)

    def with_appearance(self, visual: "Visual", link: str) -> "Visual":
        """Return a visual with the properties of its link's <visual> blocks, which apply to every visual
        (InsertSDFExtensionVisual).
        """
        blocks = self._all(link, "visual")
        if blocks:
            from ..sdf.link import with_appearance

            for block in blocks:
                visual = with_appearance(visual, block, self._context)
        return visual

    def with_contact(self, collision: "Collision", link: str) -> "Collision":
        """Return a collision with the contact parameters of its link's blocks; later blocks override earlier ones."""
        for tag in CONTACT_TAGS:
            self._all(link, tag)
        for block in self._blocks.get(link, []):
            collision = with_contact_tags(collision, block, self._context)
        return collision

    def number(self, reference: str, tag: str, default: float) -> float:
        """Return a number, or the default if no block has it."""
        node = self._last(reference, tag)
        return default if node is None else node.as_number(default=default)

    def lumped_damping(self, lump: Lump) -> tuple[float, float]:
        """Return linear and angular damping: the last <dampingFactor> for both, or SDF's own <velocity_decay>."""
        linear = angular = 0.0
        for name, _ in lump.parts:
            linear, angular = (self.number(name, "dampingFactor", value) for value in (linear, angular))
            if (node := self._last(name, "velocity_decay")) is not None:
                linear = node.number("linear", default=linear)
                angular = node.number("angular", default=angular)
        return linear, angular

    def sensors(self, reference: str) -> "tuple[Sensor, ...]":
        """Read the <sensor> elements of a link or joint, which are SDF."""
        nodes = self._all(reference, "sensor")
        if not nodes:
            return ()
        from ..sdf.sensor import read_sensor

        graph = FrameGraph(MODEL, self._context.report)
        return tuple(read_sensor(node, reference, graph, self._context) for node in nodes)

    def lumped_sensors(self, lump: Lump) -> "tuple[Sensor, ...]":
        """Read the sensors of all links of a lump, in its frame."""
        sensors = [
            replace(sensor, link_from_sensor=pose @ sensor.link_from_sensor)
            for name, pose in lump.parts
            for sensor in self.sensors(name)
        ]
        if not sensors:
            return ()
        from ..sdf.sensor import with_unique_names

        return with_unique_names(sensors, lump.name, self._context)

    def lights(self, link: str) -> "tuple[Light, ...]":
        """Read the <light> elements of a link, which are SDF."""
        nodes = self._all(link, "light")
        if not nodes:
            return ()
        from ..sdf.light import read_light

        graph = FrameGraph(MODEL, self._context.report)
        return tuple(read_light(node, link, graph, self._context) for node in nodes)

    def plugins(self, reference: str) -> "tuple[PluginTag, ...]":
        """Read the <plugin> elements."""
        nodes = self._all(reference, "plugin")
        if not nodes:
            return ()
        from ..sdf.sensor import read_plugin

        return tuple(map(read_plugin, nodes))

    def links(self, graph: FrameGraph) -> "tuple[Link, ...]":
        """Read the <link> elements of the whole robot, which are SDF: bodies outside the tree."""
        nodes = self._all("", "link")
        if not nodes:
            return ()
        from ..sdf.link import read_link
        from ..sdf.model import placed_links

        placed = placed_links(nodes, graph, self._context)
        return tuple(read_link(node, name, graph, self._context) for name, node in placed.items())

    def models(self, graph: FrameGraph) -> "tuple[Model, ...]":
        """Read the models that a <model> or <include> of the whole robot nests in it."""
        nodes = [*self._all("", "model"), *self._all("", "include")]
        if not nodes:
            return ()
        from ..sdf.include import open_include, read_included_model
        from ..sdf.model import read_model

        parts: list[UnplacedModel] = []
        for node in nodes:
            if node.tag == "model":
                opened, part = True, read_model(node, self._context, 1)
            else:
                opened = open_include(node, self._context)
                part = opened and read_included_model(node, *opened, self._context, read_model)
            if part and part.model.name not in graph:
                part.add_to(graph)
                parts.append(part)
            elif opened:
                reason = f"a second {part.model.name!r} in the robot" if part else "no <model> in the included file"
                self._context.report.warn(node.at, f"{reason}; it is left out", "duplicate-name")
        return tuple(replace(part.model, world_from_model=graph.pose(part.model.name)) for part in parts)

    def joints(self, graph: FrameGraph) -> "tuple[Joint, ...]":
        """Read the <joint> elements of the whole robot, which are SDF: a URDF closes loops with them."""
        nodes = self._all("", "joint")
        if not nodes:
            return ()
        from ..sdf.model import JointElement

        sound: list[JointElement] = []
        for node in nodes:
            try:
                joint = JointElement(node, graph, self._context)
            except DescriptionError as error:
                self._context.report.warn(error.at, f"{error.what}; the joint is left out", error.id)
                continue
            if joint.is_sound:
                sound.append(joint)
        for joint in sound:
            joint.add_to(graph)
        # A lumped link is not part of the model: the joint refers to the lump's link.
        return tuple(replace(joint.read(graph, self._context), parent_frame=None, child_frame=None) for joint in sound)

    def name_tuning(self) -> None:
        """Note the ignored parameters of Gazebo's engines."""
        for reference, tag in self._nodes:
            if tag == _IGNORED:
                self._all(reference, tag)
            if tag in _TUNING:
                for node in self._all(reference, tag):
                    self._context.report.info(
                        node.at, f"<{tag}> tunes Gazebo's engines; it is ignored", "engine-tuning"
                    )

    def report_unread(self, known: Collection[str], lumped: Collection[str]) -> None:
        """Warn of the elements that were not read.

        Args:
            known: names of links and joints.
            lumped: names of the joints inside lumps.
        """
        for (reference, tag), nodes in self._nodes.items():
            if (reference, tag) in self._read and (reference in known or not reference):
                continue
            target = f"{reference!r}" if reference else "the robot"
            why, consequence = "is not supported", "it is ignored"
            if tag in _SLIPS:
                why = "is ignored, as in Gazebo"
                consequence = f"<collision><surface><friction><ode><{tag}> is not"
            if reference in lumped:
                why = "is for a fixed joint that is lumped (<preserveFixedJoint>1</preserveFixedJoint> keeps it)"
            elif reference and reference not in known:
                why = "names no known link or joint"
            for node in nodes:
                self._context.report.warn(
                    node.at, f"<{tag}> for {target} in <gazebo> {why}; {consequence}", "gazebo-tag"
                )

    def _all(self, reference: str, tag: str) -> list[XmlNode]:
        self._read.add((reference, tag))
        return self._nodes.get((reference, tag), [])

    def _last(self, reference: str, tag: str) -> XmlNode | None:
        """Return the last block's element."""
        return last_value(self._all(reference, tag))

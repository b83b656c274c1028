"""Elements of SDF as the development kit's library reads them."""

from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import XmlNode, parse_xml
from trundle.robots.description.writing import write_sdf, written_uri
from trundle.robots.model import Model, World


def elements_of(node: XmlNode) -> bytes:
    """Return an element and those inside: depth, name, text and attributes of each, with a zero after every word."""
    words: list[str] = []
    _append(node, 0, words)
    return "".join(f"{word.replace(chr(0), '')}\0" for word in words).encode("utf-8", "surrogateescape")


def _append(node: XmlNode, depth: int, words: list[str]) -> None:
    attributes = node.attributes()
    words += (str(depth), node.tag, node.text, str(len(attributes)))
    for pair in attributes.items():
        words += pair
    for child in node.children:
        _append(child, depth + 1, words)


def model_elements(world: World, model: Model) -> bytes:
    """Return the <model> of one of a world's models."""
    return elements_of(_written(World(name=world.name, at=world.at, models=(model,)), "model", is_world=False))


def world_elements(world: World) -> bytes:
    """Return the <world> without models, lights and plugins."""
    empty = replace(world, models=(), joints=(), actors=(), lights=(), plugins=())
    return elements_of(_written(empty, "world", is_world=True))


def _written(world: World, tag: str, *, is_world: bool) -> XmlNode:
    report = Diagnostics()
    text = write_sdf(world, is_world=is_world, uri_of=written_uri, report=report)
    node = parse_xml(text, name="world", report=report).find(tag)
    assert node is not None
    return node

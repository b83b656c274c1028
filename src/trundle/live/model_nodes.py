"""Nodes of the plugins of each model, which end with it."""

from collections.abc import Callable

from trundle.ros import GraphLoop, Node


class ModelNodes:
    """Nodes of the plugins of one simulation, by model; "" is the world."""

    def __init__(self, loop: GraphLoop, make_node: Callable[[str], Node]) -> None:
        """Prepare.

        Args:
            loop: of the nodes.
            make_node: makes a node of a name.
        """
        self._loop = loop
        self._make_node = make_node
        self._nodes: dict[str, list[Node]] = {}

    def maker(self, model: str) -> Callable[[str], Node]:
        """Return a function that makes nodes of a model."""

        def make(name: str) -> Node:
            node = self._make_node(name)
            self._nodes.setdefault(model, []).append(node)
            return node

        return make

    def shut_down(self, model: str) -> None:
        """Shut down the nodes of a deleted model."""
        for node in self._nodes.pop(model, []):
            self._loop.run(node.shutdown())

    def close(self) -> None:
        """Shut down every node without waiting; from any thread."""
        for nodes in self._nodes.values():
            for node in nodes:
                self._loop.spawn(node.shutdown())
        self._nodes.clear()

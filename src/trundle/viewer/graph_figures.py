"""Drawings of a graph for the page: its nodes and topics, and numbers of messages over time."""

import asyncio
import contextlib

from trundle.diagnostics import TrundleError
from trundle.drawing import NodeGraph, curves_svg, graph_svg, node_graph
from trundle.ros import Node, TopicField, TopicSeries, recent_curves, split_topic, spread_fields, subscribe_series

_PERIOD_S = 1.0
_SHOWN_S = 30.0
"""Curves show this much."""
GRAPH, PLOT = "Graph", "Plot"


class GraphFigures:
    """Draws them again and again, while somebody wants them."""

    def __init__(self, node: Node) -> None:
        """`node` asks and listens."""
        self._node = node
        self._shows_graph = False
        self._fields: list[str] = []
        self._traces: list[TopicSeries] = []
        self._task: asyncio.Task[None] | None = None
        self.drawings: dict[str, str] = {}
        """The newest, by title."""
        self._drawn: NodeGraph | None = None
        self._picture = ""

    @property
    def titles(self) -> tuple[str, ...]:
        """Of those that are wanted."""
        return (*[GRAPH] * self._shows_graph, *[PLOT] * bool(self._fields or self._traces))

    def want(self, *, graph: bool, fields: list[str]) -> None:
        """Draw the nodes and topics, and what else is asked for; on the graph's loop."""
        self._shows_graph |= graph
        self._fields += [name for text in fields for name in spread_fields(text)]
        if self._task is None and self.titles:
            self._task = asyncio.create_task(self._draw())

    def close(self) -> None:
        """Draw no more."""
        if self._task is not None:
            self._task.cancel()

    async def _draw(self) -> None:
        while True:
            with contextlib.suppress(TrundleError):  # a master that is gone may come back
                if self._shows_graph:
                    publishers, subscribers, _ = await self._node.master.call("getSystemState")
                    drawing = node_graph(dict(publishers), dict(subscribers), with_all=False)
                    if drawing != self._drawn:  # of a large graph it takes a while
                        self._drawn, self._picture = drawing, await asyncio.to_thread(graph_svg, drawing)
                    self.drawings[GRAPH] = self._picture
                await self._find_topics()
            if self._traces:
                curves = recent_curves(self._traces, last_s=_SHOWN_S)
                self.drawings[PLOT] = await asyncio.to_thread(curves_svg, curves)
            await asyncio.sleep(_PERIOD_S)

    async def _find_topics(self) -> None:
        """Listen to what is there by now of what is asked for; what holds no number is said, once."""
        if not self._fields:
            return
        types = {topic: kind for topic, kind in await self._node.master.call("getTopicTypes") if kind != "*"}
        for name in list(self._fields):
            found = split_topic(name, types)
            if found is None:
                continue
            self._fields.remove(name)
            trace = TopicSeries(name, TopicField(topic=found[0], type=types[found[0]], path=found[1]))
            try:
                subscribe_series(trace, self._node, self._node.clock)
            except TrundleError as error:
                self._node.log.error(f"rqt_plot: {error}")
            else:
                self._traces.append(trace)

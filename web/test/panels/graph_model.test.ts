import { expect, test } from "vitest";

import { graphDrawing, neighbourhood, nodeNames, type GraphView } from "../../src/panels/graph/graph_model";

const graph = {
  types: new Map<string, string>(),
  publishers: new Map([
    ["/scan", ["/laser"]],
    ["/rosout", ["/laser", "/slam"]],
    ["/map", ["/slam"]],
  ]),
  subscribers: new Map([
    ["/scan", ["/slam", "/rqt_plot_1"]],
    ["/rosout", ["/rosout"]],
    ["/cmd_vel", ["/base"]],
  ]),
  services: new Map([["/idle/get_loggers", ["/idle"]]]),
};

function names(view: GraphView, hideDebug = true, text = ""): string[] {
  const drawing = graphDrawing(graph, { view, hideDebug, text });
  return [
    ...drawing.vertices.map((vertex) => vertex.id),
    ...drawing.edges.map((edge) => `${edge.from} > ${edge.to}`),
  ].sort();
}

test("nodes only: an arrow stands for the topics between two nodes", () => {
  expect(names("Nodes only")).toEqual([
    "node /base",
    "node /idle",
    "node /laser",
    "node /laser > node /slam",
    "node /slam",
  ]);
});

test("active topics have both ends, all topics one", () => {
  const active = names("Nodes/Topics (active)");
  expect(active).toContain("topic /scan");
  expect(active).not.toContain("topic /map");
  expect(names("Nodes/Topics (all)")).toEqual(
    expect.arrayContaining(["topic /map", "topic /cmd_vel", "topic /cmd_vel > node /base"]),
  );
});

test("debug nodes and topics are shown on request", () => {
  expect(names("Nodes/Topics (active)", false)).toEqual(
    expect.arrayContaining(["node /rqt_plot_1", "topic /rosout", "node /rosout"]),
  );
});

test("a command's node is shown, and rqt_graph's debug nodes and topics are counted", () => {
  const commanded = {
    ...graph,
    publishers: new Map([
      ["/cmd_vel", ["/rostopic_4711_1795900000"]],
      ["/clock", ["/sim"]],
      ["/wheels/monitor", ["/sim"]],
      ["/rosout", ["/sim"]],
    ]),
    subscribers: new Map([
      ["/cmd_vel", ["/arbotix", "/record_1"]],
      ["/clock", ["/arbotix"]],
      ["/wheels/monitor", ["/arbotix"]],
      ["/rosout", ["/rosout", "/trundle_page_1"]],
    ]),
  };
  const drawing = graphDrawing(commanded, { view: "Nodes/Topics (active)", hideDebug: true, text: "" });
  expect(drawing.vertices.map(({ name }) => name).sort()).toEqual([
    "/arbotix",
    "/cmd_vel",
    "/idle",
    "/record_1",
    "/rostopic_4711_1795900000",
    "/sim",
  ]);
  expect(drawing.hidden).toBe(5); // /clock, /wheels/monitor, /rosout twice, the page
  const nodes = graphDrawing(commanded, { view: "Nodes only", hideDebug: true, text: "" });
  expect(nodes.edges).toContainEqual({ from: "node /sim", to: "node /arbotix", topics: ["/wheels/monitor"] });
  expect(nodes.hidden).toBe(2);
  expect(graphDrawing(commanded, { view: "Nodes only", hideDebug: false, text: "" }).hidden).toBe(0);
});

test("a filter keeps matches and their neighbours", () => {
  expect(names("Nodes/Topics (all)", true, "LASER")).toEqual([
    "node /laser",
    "node /laser > topic /scan",
    "topic /scan",
  ]);
});

test("hovering a topic highlights its nodes", () => {
  const drawing = graphDrawing(graph, { view: "Nodes/Topics (all)", hideDebug: true, text: "" });
  expect([...neighbourhood(drawing, "topic /scan")].sort()).toEqual(["node /laser", "node /slam", "topic /scan"]);
  expect(nodeNames(graph)).toContain("/idle");
});

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

/** The graph of nodes and topics, as rqt_graph filters it. */

import type { GraphInfo } from "../../protocol/connection";
/** rqt_graph's three views. */
export type GraphView = "Nodes only" | "Nodes/Topics (active)" | "Nodes/Topics (all)";
export const GRAPH_VIEWS: readonly GraphView[] = ["Nodes only", "Nodes/Topics (active)", "Nodes/Topics (all)"];

interface Vertex {
  readonly id: string;
  readonly kind: "node" | "topic";
  readonly name: string;
}

interface Edge {
  readonly from: string;
  readonly to: string;
  /** Topics of the edge; one, unless only nodes are shown. */
  readonly topics: readonly string[];
}

export interface Drawing {
  readonly vertices: readonly Vertex[];
  readonly edges: readonly Edge[];
  /** Number of this view's nodes and topics that `hideDebug` hides. */
  readonly hidden: number;
}

export interface GraphFilter {
  readonly view: GraphView;
  /** Hide debug nodes and topics, as rqt_graph does. */
  readonly hideDebug: boolean;
  /** Part of a name; a node or topic that has it, and its neighbours, remain. */
  readonly text: string;
}

/** Parts of the names of rqt_graph's debug nodes and topics (QUIET_NAMES), and of pages, which take rqt's place. */
const DEBUG_NAMES = [
  "/diag_agg",
  "/runtime_logger",
  "/pr2_dashboard",
  "/rviz",
  "/rosout",
  "/cpu_monitor",
  "/monitor",
  "/hd_monitor",
  "/rxloggerlevel",
  "/clock",
  "/rqt",
  "/statistics",
  "/trundle_page_",
];
/** Topics that make no arrow between nodes. */
const DEBUG_TOPICS = ["/time", "/clock", "/rosout", "/statistics"];

function isDebug(name: string): boolean {
  return DEBUG_NAMES.some((part) => name.includes(part));
}

/** Nodes and topics to draw, with arrows from publishers to subscribers. */
export function graphDrawing(graph: GraphInfo, filter: GraphFilter): Drawing {
  const drawing = drawn(graph, filter.view, filter.hideDebug);
  const all = filter.hideDebug ? drawn(graph, filter.view, false) : drawing;
  return matching({ ...drawing, hidden: all.vertices.length - drawing.vertices.length }, filter.text);
}

function drawn(graph: GraphInfo, view: GraphView, hideDebug: boolean): Omit<Drawing, "hidden"> {
  const isShown = (node: string): boolean => !hideDebug || !isDebug(node);
  const isShownTopic = (topic: string): boolean =>
    !hideDebug || !(DEBUG_TOPICS.includes(topic) || (view !== "Nodes only" && isDebug(topic)));
  const ends = (of: ReadonlyMap<string, readonly string[]>, topic: string): readonly string[] =>
    (of.get(topic) ?? []).filter(isShown);
  const topics = [...new Set([...graph.publishers.keys(), ...graph.subscribers.keys()])].filter(isShownTopic).sort();
  const vertices = new Map<string, Vertex>();
  const edges = new Map<string, Edge>();
  const addNode = (name: string): string => add(vertices, { id: `node ${name}`, kind: "node", name });
  for (const node of nodeNames(graph)) if (isShown(node)) addNode(node);
  for (const topic of topics) {
    const from = ends(graph.publishers, topic);
    const to = ends(graph.subscribers, topic);
    if (view === "Nodes only") {
      for (const one of from) for (const other of to) connect(edges, addNode(one), addNode(other), topic);
    } else if (view === "Nodes/Topics (all)" ? from.length + to.length > 0 : from.length > 0 && to.length > 0) {
      const id = add(vertices, { id: `topic ${topic}`, kind: "topic", name: topic });
      for (const one of from) connect(edges, addNode(one), id, topic);
      for (const other of to) connect(edges, id, addNode(other), topic);
    }
  }
  return { vertices: [...vertices.values()], edges: [...edges.values()] };
}

/** Names of all nodes, sorted. */
export function nodeNames(graph: GraphInfo): readonly string[] {
  const all = [graph.publishers, graph.subscribers, graph.services].flatMap((of) => [...of.values()].flat());
  return [...new Set(all)].sort();
}

/** Vertices and edges that touch a vertex, highlighted on hover. */
export function neighbourhood(drawing: Drawing, id: string): ReadonlySet<string> {
  const ids = new Set([id]);
  for (const edge of drawing.edges) {
    if (edge.from === id) ids.add(edge.to);
    if (edge.to === id) ids.add(edge.from);
  }
  return ids;
}

function add(vertices: Map<string, Vertex>, vertex: Vertex): string {
  if (!vertices.has(vertex.id)) vertices.set(vertex.id, vertex);
  return vertex.id;
}

function connect(edges: Map<string, Edge>, from: string, to: string, topic: string): void {
  const key = `${from}\n${to}`;
  const topics = edges.get(key)?.topics ?? [];
  edges.set(key, { from, to, topics: [...topics, topic] });
}

function matching(drawing: Drawing, text: string): Drawing {
  const part = text.trim().toLowerCase();
  if (part === "") return drawing;
  const hits = drawing.vertices.filter((vertex) => vertex.name.toLowerCase().includes(part));
  const ids = new Set(hits.flatMap((vertex) => [...neighbourhood(drawing, vertex.id)]));
  return {
    ...drawing,
    vertices: drawing.vertices.filter((vertex) => ids.has(vertex.id)),
    edges: drawing.edges.filter((edge) => ids.has(edge.from) && ids.has(edge.to)),
  };
}

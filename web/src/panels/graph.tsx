/** Nodes and topics as a drawing (rqt_graph). */

import { computed, signal } from "@preact/signals";
import type { JSX } from "preact";
import { useRef } from "preact/hooks";

import type { Connection } from "../protocol/connection";
import { Button } from "../theme/button";
import { Select } from "../theme/select";
import { GraphDrawing, type DrawnArrow, type DrawnBox } from "./graph/graph_drawing";
import { GRAPH_VIEWS, graphDrawing, type Drawing, type GraphView } from "./graph/graph_model";
import { PanZoom } from "./graph/pan_zoom";
import { svgFile } from "./graph/svg_file";
import type { Panel, PanelProps } from "./panel";
import { FilterButton, FilterField } from "./parts";
import { perPage } from "./per_page";
import { saveFile } from "./use";

class GraphState {
  readonly view = signal<GraphView>("Nodes/Topics (active)");
  readonly hideDebug = signal(true);
  readonly filter = signal("");
  readonly isFiltering = signal(false);
  readonly panZoom = new PanZoom();
  readonly element: { current: HTMLElement | null } = { current: null };
  readonly drawing;

  constructor(connection: Connection) {
    this.drawing = computed(() =>
      graphDrawing(connection.graph.value, {
        view: this.view.value,
        hideDebug: this.hideDebug.value,
        text: this.filter.value,
      }),
    );
  }

  save(): void {
    const drawing = this.element.current?.querySelector("svg");
    if (!drawing) return;
    const box = drawing.getBBox();
    saveFile("graph.svg", svgFile(drawing, [Math.ceil(box.x + box.width + 8), Math.ceil(box.y + box.height + 8)]));
  }
}

const graphState = perPage((page) => new GraphState(page.connection));

function Graph({ page }: PanelProps): JSX.Element {
  const state = graphState(page);
  const drawing = state.drawing.value;
  const element = useRef<HTMLDivElement>(null);
  state.element.current = element.current;
  return (
    <div class="stack" ref={(div) => void (state.element.current = div)}>
      {state.isFiltering.value && <FilterField label="Filter nodes and topics" value={state.filter} />}
      {drawing.vertices.length === 0 && <div class="empty">{emptyText(state)}</div>}
      <GraphDrawing
        label="Graph of nodes and topics"
        boxes={boxes(drawing)}
        arrows={arrows(drawing)}
        direction="LR"
        panZoom={state.panZoom}
      />
    </div>
  );
}

function emptyText(state: GraphState): string {
  if (state.filter.value !== "") return "No node or topic matches the filter.";
  return state.hideDebug.value ? "There are no nodes except debug nodes." : "There are no nodes.";
}

function boxes(drawing: Drawing): readonly DrawnBox[] {
  return drawing.vertices.map(({ id, kind, name }) => {
    const before = drawing.edges.filter((edge) => edge.to === id).length;
    const after = drawing.edges.filter((edge) => edge.from === id).length;
    return { id, name, kind, title: `${kind} ${name}: ${before} in, ${after} out` };
  });
}

function arrows(drawing: Drawing): readonly DrawnArrow[] {
  return drawing.edges.map(({ from, to, topics }) => ({ from, to, title: topics.join("\n") }));
}

function Actions({ page }: PanelProps): JSX.Element {
  const state = graphState(page);
  const { hidden } = state.drawing.value;
  return (
    <>
      <Select
        label="Graph view"
        value={state.view.value}
        choices={GRAPH_VIEWS}
        onChange={(view) => {
          state.view.value = GRAPH_VIEWS.find((known) => known === view) ?? "Nodes only";
          state.panZoom.fit();
        }}
      />
      <Button small on={state.hideDebug.value} onClick={() => void (state.hideDebug.value = !state.hideDebug.value)}>
        Hide debug
      </Button>
      {hidden > 0 && <span class="xs dim">{hidden} hidden</span>}
      <FilterButton on={state.isFiltering} text={state.filter} />
      <Button small icon="focus" label="Fit" onClick={() => state.panZoom.fit()} />
      <Button small icon="download" onClick={() => state.save()}>
        SVG
      </Button>
    </>
  );
}

export const graphPanel: Panel = {
  id: "graph",
  title: "Graph",
  programs: ["rqt_graph"],
  component: Graph,
  actions: Actions,
};

/** Nodes with their publications, subscriptions and services (rosnode info). */

import { signal } from "@preact/signals";
import type { JSX } from "preact";

import type { GraphInfo } from "../protocol/connection";
import { Button } from "../theme/button";
import { Name } from "../theme/name";
import { nodeNames } from "./graph/graph_model";
import type { Panel, PanelProps } from "./panel";
import { FilterButton, FilterField, Split } from "./parts";
import { perPage } from "./per_page";

const nodesState = perPage(() => ({
  filter: signal(""),
  isFiltering: signal(false),
  selected: signal<string | null>(null),
}));

/** Names of a node's topics or services, sorted. */
function namesOf(map: ReadonlyMap<string, readonly string[]>, node: string): readonly string[] {
  return [...map]
    .filter(([, nodes]) => nodes.includes(node))
    .map(([name]) => name)
    .sort();
}

function Nodes({ page }: PanelProps): JSX.Element {
  const state = nodesState(page);
  const graph = page.connection.graph.value;
  const part = state.filter.value.trim().toLowerCase();
  const nodes = nodeNames(graph).filter((node) => node.toLowerCase().includes(part));
  const selected = state.selected.value;
  return (
    <Split
      head={state.isFiltering.value && <FilterField label="Filter nodes" value={state.filter} />}
      detail={
        selected !== null && (
          <Detail page={page} graph={graph} node={selected} onClose={() => void (state.selected.value = null)} />
        )
      }
    >
      {nodes.length === 0 && (
        <div class="empty">{part === "" ? "There are no nodes." : "No node matches the filter."}</div>
      )}
      {nodes.length > 0 && (
        <table class="data">
          <thead>
            <tr>
              <th>Node</th>
              <th class="num">Publications</th>
              <th class="num">Subscriptions</th>
              <th class="num">Services</th>
            </tr>
          </thead>
          <tbody>
            {nodes.map((node) => (
              <tr key={node} class={node === selected ? "sel" : ""} onClick={() => void (state.selected.value = node)}>
                <td>
                  <button type="button" class="cell" aria-expanded={node === selected}>
                    {node}
                  </button>
                </td>
                <td class="num">{namesOf(graph.publishers, node).length}</td>
                <td class="num">{namesOf(graph.subscribers, node).length}</td>
                <td class="num">{namesOf(graph.services, node).length}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </Split>
  );
}

interface DetailProps extends PanelProps {
  readonly graph: GraphInfo;
  readonly node: string;
  readonly onClose: () => void;
}

function Detail({ page, graph, node, onClose }: DetailProps): JSX.Element {
  const topics = page.connection.topics.value;
  const services = page.connection.services.value;
  const sections = [
    { title: "Publications", names: namesOf(graph.publishers, node), type: (name: string) => topics.get(name)?.type },
    { title: "Subscriptions", names: namesOf(graph.subscribers, node), type: (name: string) => topics.get(name)?.type },
    { title: "Services", names: namesOf(graph.services, node), type: (name: string) => services.get(name)?.type },
  ];
  return (
    <>
      <div class="toolrow">
        <strong class="n">{node}</strong>
        <span class="sp" />
        <Button small icon="close" label="Close" onClick={onClose} />
      </div>
      <div class="scroll">
        {sections.map(({ title, names, type }) => (
          <section key={title} aria-label={title}>
            <h2 class="headline">
              {title} <span class="dim">{names.length}</span>
            </h2>
            {names.map((name) => (
              <div key={name} class="row" style={{ "--d": 1 }}>
                <Name text={name} />
                <span class="r">{type(name) ?? ""}</span>
              </div>
            ))}
          </section>
        ))}
      </div>
    </>
  );
}

function Actions({ page }: PanelProps): JSX.Element {
  const state = nodesState(page);
  return <FilterButton on={state.isFiltering} text={state.filter} />;
}

export const nodesPanel: Panel = {
  id: "nodes",
  title: "Nodes",
  programs: ["rosnode"],
  component: Nodes,
  actions: Actions,
};

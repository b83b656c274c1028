/** Topics with their rates; the selected one's messages, and a form to publish (rqt_topic, rqt_publisher). */

import type { JSX } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";

import { canControl, Controls } from "../page/view_only";
import { Button } from "../theme/button";
import { Combo } from "../theme/combo";
import type { Panel, PanelProps } from "./panel";
import { FilterButton, FilterField, Split } from "./parts";
import { TopicEcho } from "./topics/topic_echo";
import { TopicPublish } from "./topics/topic_publish";
import { TopicTable } from "./topics/topic_table";
import { allTopics, matchingTopics, topicsState, type TopicsState } from "./topics/topics_state";
import { useShown, useTick } from "./use";

const PERIOD = 500; // ms

function Topics({ page }: PanelProps): JSX.Element {
  const state = topicsState(page);
  const { connection } = page;
  const root = useRef<HTMLDivElement>(null);
  const isShown = useShown(root);
  useTick(PERIOD, isShown);
  const topics = matchingTopics(allTopics(connection), state.filter.value);
  useEffect(() => {
    if (isShown) state.measure(topics);
    else state.rest();
  });
  useEffect(() => () => state.rest(), [state]);
  const selected = state.selected.value;
  return (
    <Split
      root={root}
      detail={selected !== null && <TopicDetail key={selected} page={page} state={state} topic={selected} />}
      head={state.isFiltering.value && <FilterField label="Filter topics" value={state.filter} />}
    >
      {topics.length === 0 ? (
        <div class="empty">{state.filter.value === "" ? "There are no topics." : "No topic matches the filter."}</div>
      ) : (
        <TopicTable connection={connection} state={state} topics={topics} now={performance.now()} />
      )}
    </Split>
  );
}

interface DetailProps extends PanelProps {
  readonly state: TopicsState;
  readonly topic: string;
}

/** An entry without a topic is a new one: its name and type are typed first. */
const NEW = "";

function TopicDetail({ page, state, topic }: DetailProps): JSX.Element {
  const [view, setView] = useState<"echo" | "publish">(topic === NEW ? "publish" : "echo");
  const [name, setName] = useState(topic);
  const known = allTopics(page.connection).get(name)?.type;
  const [typed, setTyped] = useState("");
  const type = known ?? typed;
  return (
    <>
      <div class="toolrow">
        {topic === NEW ? (
          <NewTopic page={page} name={name} type={type} onName={setName} onType={setTyped} />
        ) : (
          <>
            <strong class="n">{topic}</strong>
            <Button small on={view === "echo"} onClick={() => setView("echo")}>
              Echo
            </Button>
            <Button small on={view === "publish"} onClick={() => setView("publish")}>
              Publish
            </Button>
          </>
        )}
        <span class="sp" />
        <Button small icon="close" label="Close" onClick={() => void (state.selected.value = null)} />
      </div>
      <div class="scroll">
        {view === "echo" && <TopicEcho connection={page.connection} topic={topic} />}
        {view === "publish" && name.startsWith("/") && type !== "" && (
          <Controls page={page}>
            <TopicPublish key={`${name} ${type}`} publication={state.publication(name, type)} />
          </Controls>
        )}
      </div>
    </>
  );
}

interface NewTopicProps extends PanelProps {
  readonly name: string;
  readonly type: string;
  readonly onName: (name: string) => void;
  readonly onType: (type: string) => void;
}

function NewTopic({ page, name, type, onName, onType }: NewTopicProps): JSX.Element {
  const topics = allTopics(page.connection);
  const types = new Set([...topics.values()].map((topic) => topic.type));
  return (
    <>
      <span class="sm t2">Topic</span>
      <Combo
        label="Topic"
        value={name}
        choices={() => [...topics.values()].map((topic) => ({ value: topic.name, detail: topic.type }))}
        onCommit={(text) => onName(text === "" || text.startsWith("/") ? text : `/${text}`)}
      />
      <span class="sm t2">Type</span>
      <Combo
        label="Type"
        value={type}
        choices={() => [...types].sort().map((value) => ({ value }))}
        onCommit={onType}
      />
    </>
  );
}

function Actions({ page }: PanelProps): JSX.Element {
  const state = topicsState(page);
  return (
    <>
      {canControl(page) && (
        <Button small icon="plus" onClick={() => void (state.selected.value = NEW)}>
          Publish
        </Button>
      )}
      <FilterButton on={state.isFiltering} text={state.filter} />
    </>
  );
}

export const topicsPanel: Panel = {
  id: "topics",
  title: "Topics",
  programs: ["rqt_topic", "rqt_publisher", "rostopic"],
  component: Topics,
  actions: Actions,
};

/** Topics with their type, rate, bandwidth, age and losses. */

import type { JSX } from "preact";

import type { Connection, TopicInfo } from "../../protocol/connection";
import { fixed } from "../../theme/format";
import { Name } from "../../theme/name";
import { StatusShape } from "../../theme/status_shape";
import { age, bytes } from "../messages/format";
import { topicLevel, type TopicsState } from "./topics_state";

interface TopicTableProps {
  readonly connection: Connection;
  readonly state: TopicsState;
  readonly topics: readonly TopicInfo[];
  /** Time of `performance.now()` [ms]; rates are drawn again when it changes. */
  readonly now: number;
}

export function TopicTable({ connection, state, topics, now }: TopicTableProps): JSX.Element {
  return (
    <table class="data topics">
      <thead>
        <tr>
          <th>Topic</th>
          <th>Type</th>
          <th class="num">Hz</th>
          <th class="num">Bandwidth</th>
          <th class="num">Age</th>
          <th class="num">Dropped</th>
        </tr>
      </thead>
      <tbody>
        {topics.map((topic) => (
          <Row key={topic.name} connection={connection} state={state} topic={topic} now={now} />
        ))}
      </tbody>
    </table>
  );
}

function Row({
  connection,
  state,
  topic,
  now,
}: Omit<TopicTableProps, "topics"> & { readonly topic: TopicInfo }): JSX.Element {
  const { name, type } = topic;
  const statistics = connection.statistics(name);
  const isSelected = state.selected.value === name;
  const isPublishing = state.publications.value.some((one) => one.topic === name && one.isRunning.value);
  const { rate, bandwidth, lastAt, dropped } = statistics;
  const select = (event: Event): void => {
    event.stopPropagation();
    state.selected.value = isSelected ? null : name;
  };
  const measure = (event: Event): void => {
    event.stopPropagation();
    state.ask(name);
  };
  return (
    <tr class={isSelected ? "sel" : ""} onClick={select}>
      <td>
        <span class="w">
          <StatusShape level={topicLevel(statistics, now)} />
          <button type="button" class="cell" aria-expanded={isSelected} onClick={select}>
            <Name text={name} />
          </button>
          {isPublishing && <span class="badge">publishing</span>}
        </span>
      </td>
      <td class="t2 type">
        <Name text={type} />
      </td>
      {lastAt === null && !state.isMeasured(topic) ? (
        <td class="num" colSpan={3}>
          <button type="button" class="cell link" onClick={measure}>
            Measure
          </button>
        </td>
      ) : (
        <>
          <td class="num">{rate !== null && rate < 0.05 ? "—" : fixed(rate, 1)}</td>
          <td class="num">{lastAt === null || bandwidth < 0.5 ? "—" : `${bytes(bandwidth)}/s`}</td>
          <td class={lastAt === null ? "num dim" : "num"}>{lastAt === null ? "never" : age((now - lastAt) / 1000)}</td>
        </>
      )}
      <td class={dropped > 0 ? "num warned" : "num dim"}>{dropped}</td>
    </tr>
  );
}

/** Differences of a simulation, a graph or a recording from a recording: of models, joints, frames and numbers. */

import type { JSX } from "preact";
import { useEffect, useRef } from "preact/hooks";

import { canControl } from "../page/view_only";
import type { Page } from "../page/page";
import type { ReferenceInfo } from "../protocol/generated/page_messages";
import { Button } from "../theme/button";
import { fixed } from "../theme/format";
import { Name } from "../theme/name";
import { NumberField } from "../theme/number_field";
import { compareState, progressText, type CompareRow } from "./compare/compare_state";
import { significant, timeText } from "./messages/format";
import type { Panel, PanelProps } from "./panel";
import { timelineState } from "./timeline/timeline_state";
import { saveFile, useShown } from "./use";

const COMMAND = "compare";
const MAX_OFFSET = 1e6;

function Compare({ page }: PanelProps): JSX.Element {
  const state = compareState(page);
  const root = useRef<HTMLDivElement>(null);
  const isShown = useShown(root);
  useEffect(() => {
    if (!isShown) return;
    const subscription = state.follow();
    return () => subscription.close();
  }, [state, isShown]);
  const info = page.world.referenceInfo.value;
  const rows = state.rows();
  return (
    <div class="stack" ref={root}>
      {state.fault.value !== "" && (
        <div class="fault pad" role="alert">
          {state.fault.value}
        </div>
      )}
      {info === null ? (
        <Empty page={page} />
      ) : (
        <>
          <Head page={page} info={info} />
          <div class="scroll">
            {rows.length === 0 ? (
              <div class="empty">There is nothing to compare at this time.</div>
            ) : (
              <Table page={page} rows={rows} />
            )}
          </div>
        </>
      )}
    </div>
  );
}

function Empty({ page }: { readonly page: Page }): JSX.Element {
  const command = page.commands.all.value.find(({ id }) => id === COMMAND);
  if (command === undefined)
    return <div class="empty">A simulation, a graph or a recording can be compared; this page has none.</div>;
  return (
    <div class="empty line">
      Nothing is compared.
      {canControl(page) && (
        <Button small tone="line" onClick={() => command.run()}>
          {command.title}
        </Button>
      )}
    </div>
  );
}

function Head({ page, info }: { readonly page: Page; readonly info: ReferenceInfo }): JSX.Element {
  const state = compareState(page);
  const time = state.differences.value?.time;
  return (
    <div class="toolrow compared">
      <i class="ghost" />
      <span class="n" title={info.title}>
        <Name text={info.title} />
      </span>
      <span class="sm t2 progress" role="status">
        {time === undefined ? "" : progressText(info, time)}
      </span>
      <span class="sp" />
      <span class="sm t2">Offset</span>
      <span class="narrow">
        <NumberField
          label="Offset"
          unit="s"
          class="small num"
          value={info.offset}
          min={-MAX_OFFSET}
          max={MAX_OFFSET}
          disabled={!canControl(page)}
          onCommit={(offset) => state.setOffset(offset)}
        />
      </span>
    </div>
  );
}

function Table({ page, rows }: { readonly page: Page; readonly rows: readonly CompareRow[] }): JSX.Element {
  return (
    <table class="data differences">
      <caption class="sr">Differences from the reference</caption>
      <thead>
        <tr>
          <th scope="col">Name</th>
          <th scope="col">Quantity</th>
          {["Now", "Maximum", "At", "RMS"].map((title) => (
            <th key={title} scope="col" class="num">
              {title}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {rows.map((row) => (
          <tr key={`${row.name} ${row.quantity}`}>
            <td title={row.name}>
              <Name text={row.name} />
            </td>
            <td class="t2">{row.quantity}</td>
            <Value value={row.now} row={row} />
            <Value value={row.maximum} row={row} />
            <td class="num">
              <MaximumTime page={page} row={row} />
            </td>
            <Value value={row.rms} row={row} />
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Value({ value, row }: { readonly value: number | null; readonly row: CompareRow }): JSX.Element {
  const { quantity, unit } = row;
  const isNumber = quantity === "value" && unit !== "m";
  return (
    <td class="num">
      {isNumber && value !== null ? significant(value, 3) : fixed(value, unit === "°" ? 2 : 3)}
      {value !== null && unit !== "" && <i class="unit">{unit}</i>}
    </td>
  );
}

/** Time of the maximum; a press goes there. */
function MaximumTime({ page, row }: { readonly page: Page; readonly row: CompareRow }): JSX.Element {
  const timeline = timelineState(page);
  const { name, quantity, maximumTime } = row;
  if (maximumTime === null) return <>—</>;
  const text = timeText(maximumTime);
  const span = timeline.span();
  if (!timeline.canSeek() || span === null || maximumTime < span.start || maximumTime > span.end) return <>{text}</>;
  return (
    <button
      type="button"
      class="cell link"
      aria-label={`Go to the maximum of ${name} ${quantity}, at ${text}`}
      onClick={() => timeline.seek(maximumTime)}
    >
      {text}
    </button>
  );
}

function Actions({ page }: PanelProps): JSX.Element | null {
  const state = compareState(page);
  if (page.world.referenceInfo.value === null) return null;
  const save = (): void => saveFile("differences.csv", new Blob([state.csv()], { type: "text/csv" }));
  return (
    <>
      <Button small icon="download" disabled={state.differences.value === null} onClick={save}>
        Save CSV
      </Button>
      {canControl(page) && (
        <Button small icon="close" onClick={() => state.stop()}>
          Stop comparing
        </Button>
      )}
    </>
  );
}

export const comparePanel: Panel = {
  id: "compare",
  title: "Compare",
  programs: [],
  component: Compare,
  actions: Actions,
};

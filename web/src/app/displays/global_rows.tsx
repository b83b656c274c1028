/** rviz's Global Options and Global Status. */

import type { JSX } from "preact";

import { Combo } from "../../theme/combo";
import { StatusShape } from "../../theme/status_shape";
import type { TreeRow } from "../../theme/tree";
import type { Page } from "../../page/page";
import { propertyRows, type RowsOf } from "./property_rows";

const WORDS = { ok: "Ok", warn: "Warn", error: "Error", none: "Warn" } as const;

export function globalRows(rows: RowsOf): TreeRow[] {
  const { displays } = rows.page;
  const status = displays.fixedFrameStatus.value;
  const options = rows.isOpen("options");
  const open = rows.isOpen("status");
  const statusRow = (
    <>
      <StatusShape level={status.level} />
      <span class="n">Global Status: {WORDS[status.level]}</span>
      <span class="r">{status.level === "ok" ? "" : "1"}</span>
    </>
  );
  return [
    { key: "options", depth: 0, open: options, content: <span class="n">Global Options</span> },
    ...(options
      ? [fixedFrameRow(rows.page), ...propertyRows([displays.backgroundColor, displays.frameRate], "options", 1, rows)]
      : []),
    { key: "status", depth: 0, open, content: statusRow },
    ...(open
      ? [
          propertyLine(
            "status/frame",
            "Fixed Frame",
            <span class="wrap">{status.level === "ok" ? "OK" : status.text}</span>,
          ),
        ]
      : []),
  ];
}

function fixedFrameRow(page: Page): TreeRow {
  const { fixedFrameSetting: setting, fixedFrame } = page.displays;
  const set = (frame: string): void => {
    const before = setting.peek();
    page.displays.edit(
      "Change of Fixed Frame",
      () => (setting.value = frame),
      () => (setting.value = before),
    );
  };
  const choices = () => page.frames.frames.peek().map((value) => ({ value }));
  const editor = (
    <Combo
      label="Fixed Frame"
      value={setting.value === "" ? fixedFrame.value : setting.value}
      choices={choices}
      onCommit={set}
    />
  );
  return propertyLine("options/frame", "Fixed Frame", editor);
}

function propertyLine(key: string, name: string, value: JSX.Element): TreeRow {
  return {
    key,
    depth: 1,
    class: "prop",
    content: (
      <>
        <span class="k">{name}</span>
        <span class="v">{value}</span>
      </>
    ),
  };
}

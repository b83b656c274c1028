/** Frames of tf as a tree (rqt_tf_tree). */

import type { JSX } from "preact";
import { useRef } from "preact/hooks";

import type { Page } from "../page/page";
import { Button } from "../theme/button";
import { frameBoxes } from "./graph/frame_boxes";
import { GraphDrawing } from "./graph/graph_drawing";
import { PanZoom } from "./graph/pan_zoom";
import type { Panel, PanelProps } from "./panel";
import { perPage } from "./per_page";
import { useShown, useTick } from "./use";

const PERIOD = 1000; // ms

const tfState = perPage(() => ({ panZoom: new PanZoom() }));

function TfTree({ page }: PanelProps): JSX.Element {
  const state = tfState(page);
  const root = useRef<HTMLDivElement>(null);
  useTick(PERIOD, useShown(root));
  const [boxes, arrows] = frameBoxes(page.frames.describe(), page.displays.fixedFrame.value, page.connection.now());
  return (
    <div class="stack" ref={root}>
      {boxes.length === 0 && <div class="empty">No transforms have come on /tf or /tf_static.</div>}
      <GraphDrawing
        label="Tree of frames"
        boxes={boxes}
        arrows={arrows}
        direction="fit"
        panZoom={state.panZoom}
        onSelect={(frame) => select(page, frame)}
      />
    </div>
  );
}

function select(page: Page, frame: string): void {
  page.selection.value = { kind: "frame", frame };
}

function Actions({ page }: PanelProps): JSX.Element {
  return <Button small icon="focus" label="Fit" onClick={() => tfState(page).panZoom.fit()} />;
}

export const tfTreePanel: Panel = {
  id: "tf_tree",
  title: "TF tree",
  programs: ["rqt_tf_tree", "view_frames"],
  component: TfTree,
  actions: Actions,
};

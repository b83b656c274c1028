/** What the document runs first: it is small, so that session, WebGL and the rest of the page begin beside each other. */

import "./theme/tokens.css";
import "./theme/base.css";

import { cleanAddress, fetchSession } from "./app/fetch_session";
import { beginDrawing } from "./scene/drawing_canvas";

async function start(root: HTMLElement): Promise<void> {
  try {
    const coming = Promise.all([fetchSession(location.href), import("./app/boot")]);
    beginDrawing();
    const [session, { boot }] = await coming;
    history.replaceState(history.state, "", cleanAddress(location.href, session.view_only));
    boot(root, session, location.href);
  } catch (error) {
    const text = error instanceof Error ? error.message : String(error);
    const alert = document.createElement("p");
    alert.setAttribute("role", "alert");
    alert.textContent = `The page cannot be shown: ${text} Load it again when its server runs.`;
    root.replaceChildren(alert);
  }
}

const root = document.getElementById("app");
if (root !== null) void start(root);

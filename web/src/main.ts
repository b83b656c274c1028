/** First script of the document: small, so that session, WebGL and the rest of the page load in parallel. */

import "./theme/font.css";
import "./theme/tokens.css";
import "./theme/base.css";

import { beginDrawing } from "./scene/drawing_canvas";

async function start(root: HTMLElement): Promise<void> {
  try {
    const coming = Promise.all([fetchSession(), import("./app/boot")]);
    beginDrawing();
    const [session, { boot }] = await coming;
    boot(root, session);
  } catch (error) {
    const text = error instanceof Error ? error.message : String(error);
    const alert = document.createElement("p");
    alert.setAttribute("role", "alert");
    alert.textContent = `The page cannot be shown: ${text} Load it again when its server runs.`;
    root.replaceChildren(alert);
  }
}

/** Fetch the page's session as JSON; throws a sentence. */
async function fetchSession(): Promise<string> {
  const url = new URL("session.json", location.href);
  url.search = location.search; // which may mark the page as view-only
  const response = await fetch(url);
  if (!response.ok) throw new Error(`The page's server refuses: ${response.status} ${await response.text()}`);
  return response.text();
}

const root = document.getElementById("app");
if (root !== null) void start(root);

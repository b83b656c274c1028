import "./scene/conventions";
import "./theme/tokens.css";
import "./theme/base.css";

import { render } from "preact";

import { boot, fetchSession } from "./app/boot";
import { drawsOnCpu } from "./scene/draws_on_cpu";

async function start(root: HTMLElement): Promise<void> {
  try {
    const coming = fetchSession(location.href);
    drawsOnCpu(); // which takes long, as the answer does
    const session = await coming;
    boot(root, session, location.href);
  } catch (error) {
    const text = error instanceof Error ? error.message : String(error);
    render(<p role="alert">The page cannot be shown: {text} Load it again when its server runs.</p>, root);
  }
}

const root = document.getElementById("app");
if (root !== null) void start(root);

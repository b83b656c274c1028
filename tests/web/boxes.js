// Faults of the page's layout, as sentences: overlapping areas, controls that are cut off, texts cut without an ellipsis.
() => {
  const faults = [];
  const AREAS =
    ".bar, aside.panel, section.dock, .sheet, .tools, .notice, .drive.float, .disc, .pv, .tiles > .tile, .scene svg, .panename, .scene-note";
  const name = (element) => {
    const label = element.getAttribute("aria-label") ?? element.textContent.trim();
    return `${element.tagName.toLowerCase()}.${element.getAttribute("class") ?? ""} "${label.slice(0, 40)}"`;
  };
  const isEmpty = ({ width, height }) => width < 0.5 || height < 0.5;
  const cross = (a, b) => ({
    left: Math.max(a.left, b.left),
    top: Math.max(a.top, b.top),
    right: Math.min(a.right, b.right),
    bottom: Math.min(a.bottom, b.bottom),
  });
  const meet = (a, b) => {
    const { left, top, right, bottom } = cross(a, b);
    return right - left > 1 && bottom - top > 1;
  };
  const isHidden = (element) => {
    for (let at = element; at !== null; at = at.parentElement) {
      const { display, visibility, opacity } = getComputedStyle(at);
      if (display === "none" || visibility === "hidden" || opacity === "0" || at.matches(".sr, .menus, .tip")) return true;
    }
    return false;
  };
  /** The part of a box that its ancestors leave visible, and whether one that does not scroll cuts it. */
  const clip = (element, box, isText) => {
    let [visible, cut, cutter] = [box, false, null];
    let excused = false;
    for (let at = isText ? element : element.parentElement; at !== null && at !== document.body; at = at.parentElement) {
      const style = getComputedStyle(at);
      if (style.position === "fixed") {
        const own = at.getBoundingClientRect();
        if (style.overflowX === "visible") break;
        if (!excused && (box.right > own.right + 1 || box.left < own.left - 1)) [cut, cutter] = [true, at];
        visible = cross(visible, own);
        break;
      }
      if (style.overflowX === "visible" && style.overflowY === "visible") continue;
      const own = at.getBoundingClientRect();
      const scrolls = /auto|scroll/.test(style.overflowX + style.overflowY);
      if (isText && style.textOverflow === "ellipsis") excused = true;
      if (scrolls) excused = true;
      if (!excused && (box.right > own.right + 1 || box.left < own.left - 1)) [cut, cutter] = [true, at];
      visible = cross(visible, own);
    }
    return { visible, cut, cutter };
  };
  const window_ = { left: 0, top: 0, right: innerWidth, bottom: innerHeight };
  const areas = [...document.querySelectorAll(AREAS)].filter((area) => !isHidden(area));
  for (const [i, a] of areas.entries()) {
    const box = a.getBoundingClientRect();
    if (isEmpty(box)) continue;
    const { visible } = clip(a, box, false);
    if (box.left < -1 || box.top < -1 || box.right > innerWidth + 1 || box.bottom > innerHeight + 1) {
      if (meet(visible, window_)) faults.push(`${name(a)} is partly outside the window`);
    }
    const isPart = visible.right - visible.left > 1 && visible.right - visible.left < box.width - 1;
    if (isPart) faults.push(`${name(a)} is cut off`);
    for (const b of areas.slice(i + 1)) {
      if (a.contains(b) || b.contains(a)) continue;
      if (meet(visible, clip(b, b.getBoundingClientRect(), false).visible)) faults.push(`${name(a)} lies over ${name(b)}`);
    }
  }
  const shown = [];
  for (const control of document.querySelectorAll("button, [role=tab], input, select")) {
    if (isHidden(control)) continue;
    const box = control.getBoundingClientRect();
    if (isEmpty(box) || control.matches(".sl input, .grab")) continue;
    const { visible, cut, cutter } = clip(control, box, false);
    if (visible.right - visible.left < 1 || visible.bottom - visible.top < 1) continue; // scrolled away
    if (cut) faults.push(`${name(control)} is cut off by ${name(cutter)}`);
    if (visible.right > innerWidth + 1 || visible.left < -1) faults.push(`${name(control)} is outside the window`);
    shown.push([control, visible]);
  }
  const isScale = ({ parentElement }) => parentElement.closest(".timeline .ruler") !== null;
  const isTime = ({ parentElement }) => parentElement.closest(".playhead, .pointed") !== null;
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const texts = [];
  for (let node = walker.nextNode(); node !== null; node = walker.nextNode()) {
    const element = node.parentElement;
    if (node.textContent.trim() === "" || element.matches("script, style, noscript, title, option") || isHidden(element)) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    for (const box of range.getClientRects()) {
      if (isEmpty(box)) continue;
      const { visible, cut, cutter } = clip(element, box, true);
      if (visible.right - visible.left < 1 || visible.bottom - visible.top < 1) continue;
      if (cut) faults.push(`the text "${node.textContent.slice(0, 60)}" is cut without an ellipsis by ${name(cutter)}`);
      texts.push([node, visible, node.textContent]);
    }
  }
  for (const [i, [a, box, text]] of texts.entries()) {
    for (const [b, other, otherText] of texts.slice(i + 1)) {
      if ((isScale(a) && isTime(b)) || (isScale(b) && isTime(a))) continue; // the time now covers the scale
      if (a !== b && meet(box, { ...other, top: other.top + 3, bottom: other.bottom - 3 }))
        faults.push(`the text "${text.slice(0, 40)}" lies over "${otherText.slice(0, 40)}"`);
    }
  }
  return [...new Set(faults)];
}

/** Drawing of the page as an SVG file, with the style sheet's values written into the elements. */

const STYLES = [
  "fill",
  "stroke",
  "stroke-width",
  "stroke-dasharray",
  "opacity",
  "font-family",
  "font-size",
  "font-weight",
  "text-anchor",
] as const;

export function svgFile(drawing: SVGSVGElement, content: readonly [number, number]): Blob {
  const copy = drawing.cloneNode(true) as SVGSVGElement;
  const originals = [...drawing.querySelectorAll("*")];
  [...copy.querySelectorAll("*")].forEach((element, index) => {
    const original = originals[index];
    if (original === undefined) return;
    const style = getComputedStyle(original);
    for (const name of STYLES) element.setAttribute(name, style.getPropertyValue(name));
    element.removeAttribute("class");
  });
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("viewBox", `0 0 ${content[0]} ${content[1]}`);
  copy.setAttribute("width", String(content[0]));
  copy.setAttribute("height", String(content[1]));
  copy.setAttribute("style", `background: ${getComputedStyle(document.body).getPropertyValue("--panel")}`);
  return new Blob([new XMLSerializer().serializeToString(copy)], { type: "image/svg+xml" });
}

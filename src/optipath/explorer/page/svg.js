/** Pieces of drawings. All look is in style.css; one unit is a sixteenth of the text size. */

const NS = "http://www.w3.org/2000/svg";

/** @param {string} name @param {Object<string, any>} attributes @returns {SVGElement} */
export function shape(name, attributes = {}, ...children) {
  const element = document.createElementNS(NS, name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value !== null && value !== undefined) element.setAttribute(key, String(value));
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

const rounded = (number) => Math.round(number * 100) / 100;

/** @param {number[][]} points @returns {string} the `d` of a path; a gap where a point is null */
export function through(points, closed = false) {
  let pen = "M";
  const words = [];
  for (const point of points) {
    if (point === null) {
      pen = "M";
      continue;
    }
    words.push(`${pen}${rounded(point[0])} ${rounded(point[1])}`);
    pen = "L";
  }
  return words.join("") + (closed ? "Z" : "");
}

export function line(points, look, closed = false) {
  return shape("path", { d: through(points, closed), class: look });
}

export function segment(from, to, look) {
  return line([from, to], look);
}

export function dot(at, radius, look) {
  return shape("circle", { cx: rounded(at[0]), cy: rounded(at[1]), r: radius, class: look });
}

/** @param {"start"|"middle"|"end"} anchor */
export function text(at, words, look = "", anchor = "middle") {
  const attributes = { x: rounded(at[0]), y: rounded(at[1]), class: `text ${look}`.trim() };
  return shape("text", { ...attributes, "text-anchor": anchor }, words);
}

/** A head of an arrow at `tip`, which points along `direction`. */
export function head(tip, direction, size, look) {
  const length = Math.hypot(direction[0], direction[1]) || 1;
  const [x, y] = [(direction[0] / length) * size, (direction[1] / length) * size];
  const back = [tip[0] - x, tip[1] - y];
  const points = [
    tip,
    [back[0] - y * 0.42, back[1] + x * 0.42],
    [back[0] + y * 0.42, back[1] - x * 0.42],
  ];
  return line(points, look, true);
}

export function arrow(from, to, size, shaft, tip) {
  const direction = [to[0] - from[0], to[1] - from[1]];
  const length = Math.hypot(...direction);
  const end =
    length > size ? to.map((each, i) => each - (direction[i] / length) * size * 0.9) : from;
  return shape(
    "g",
    {},
    segment(from, end, shaft),
    head(to, direction, Math.min(size, length), tip),
  );
}

/** How wide a picture may be, in its units. @param {SVGElement} svg */
export function widthOf(svg) {
  const size = parseFloat(getComputedStyle(document.documentElement).fontSize);
  const wide = svg.parentElement.clientWidth;
  return Math.max(240, Math.round((wide * 16) / size));
}

/** Put a new drawing into a picture, with what it says in words. */
export function show(svg, width, height, words, ...children) {
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  svg.setAttribute("aria-label", words);
  svg.replaceChildren(...children);
}

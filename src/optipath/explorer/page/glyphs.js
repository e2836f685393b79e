/** How elements look in space. */

import { cross, plus } from "./projection.js";
import { dot, line, segment } from "./svg.js";

/**
 * @param {object} node of a scene
 * @param {(point: number[]) => number[]} at the projection
 * @param {number} size half as wide as a surface, in space
 * @returns {SVGElement[]}
 */
export function glyph(node, at, size) {
  const place = at(node.at);
  if (node.role === "source") return [dot(place, 8, "lamp"), dot(place, 3.4, "lamp-core")];
  if (node.role === "detector") return [dot(place, 8, "eye"), dot(place, 3.6, "eye-core")];
  if (node.role === "dump") return [...crossed(place)];
  const outline = outlineOf(node, size);
  if (outline.length === 1) return [dot(place, 6, "element")];
  const drawn = line(outline.map(at), isFlat(node) ? node.role : "plate", true);
  if (isFlat(node)) return [drawn];
  const [across] = sidesOf(node);
  const axis = [-1, 1].map((each) => at(plus(node.at, across, 0.96 * each * size)));
  return [drawn, segment(...axis, "plate-axis")];
}

const isFlat = ({ role }) => role === "surface" || role === "mirror";

const CORNERS = [
  [1.25, 1.25],
  [-1.25, 1.25],
  [-1.25, -1.25],
  [1.25, -1.25],
];
const RING = Array.from({ length: 33 }, (_, i) => (i * Math.PI) / 16).map((t) => [
  Math.cos(t),
  Math.sin(t),
]);

/** The points around an element, in space; its place alone where it is drawn as a mark. */
export function outlineOf(node, size) {
  const sides = ["source", "detector", "dump"].includes(node.role) ? null : sidesOf(node);
  if (sides === null) return [node.at];
  const [across, up] = sides;
  return (isFlat(node) ? CORNERS : RING).map(([a, b]) =>
    plus(plus(node.at, across, a * size), up, b * size),
  );
}

/** Two directions in the surface of an element, at a right angle. */
function sidesOf({ normal, across }) {
  if (normal === null || normal === undefined) return null;
  const other = Math.abs(normal[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0];
  const one = unit(across ?? cross(other, normal));
  return [one, unit(cross(normal, one))];
}

function unit(vector) {
  const length = Math.hypot(...vector) || 1;
  return vector.map((each) => each / length);
}

function crossed([x, y]) {
  return [
    segment([x - 5, y - 5], [x + 5, y + 5], "dump"),
    segment([x - 5, y + 5], [x + 5, y - 5], "dump"),
  ];
}

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
  const sides = sidesOf(node);
  if (sides === null) return [dot(place, 6, "element")];
  const [across, up] = sides;
  if (node.role === "surface" || node.role === "mirror") {
    const corners = [
      [1, 1],
      [-1, 1],
      [-1, -1],
      [1, -1],
    ].map(([a, b]) => at(plus(plus(node.at, across, 1.25 * a * size), up, 1.25 * b * size)));
    return [line(corners, node.role, true)];
  }
  const ring = Array.from({ length: 33 }, (_, i) => {
    const t = (i * Math.PI) / 16;
    return at(plus(plus(node.at, across, Math.cos(t) * size), up, Math.sin(t) * size));
  });
  const axis = [-1, 1].map((each) => at(plus(node.at, across, 0.96 * each * size)));
  return [line(ring, "plate", true), segment(...axis, "plate-axis")];
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

/** The curve that the electric field runs through, as seen by an eye that the light reaches. */

import { dot, head, line, segment, show, text } from "./svg.js";
import { isDark, lightInWords } from "./words.js";

const SIZE = 300;
const RADIUS = 104;

/** @param {SVGElement} svg @param {string} name of the detector @param {object} light its answer */
export function drawEllipse(svg, name, light) {
  const middle = [SIZE / 2, SIZE / 2 - 6];
  const at = ([x, y]) => [middle[0] + RADIUS * x, middle[1] - RADIUS * y];
  const { points, aop, handedness } = light.ellipse;
  const parts = [...axes(at, middle)];
  if (points === null) {
    parts.push(dot(middle, 4, "mark hollow"));
    parts.push(text([middle[0], middle[1] - 16], nothing(light), "faint"));
  } else {
    const curve = points.map(at);
    const linear = handedness === "linear";
    if (aop !== null) parts.push(...angle(at, middle, aop));
    parts.push(line(curve, "field fill", true), line(curve, "field", true));
    parts.push(...(linear ? ends(curve) : senses(curve)));
  }
  parts.push(text([SIZE / 2, SIZE - 8], caption(light), "strong"));
  show(svg, SIZE, SIZE, `Polarisation ellipse. ${lightInWords(name, light)}`, ...parts);
}

function axes(at, middle) {
  return [
    dot(middle, RADIUS, "helper dashed"),
    segment(at([-1.16, 0]), at([1.16, 0]), "helper"),
    segment(at([0, -1.16]), at([0, 1.16]), "helper"),
    head(at([1.2, 0]), [1, 0], 8, "helper-tip"),
    head(at([0, 1.2]), [0, -1], 8, "helper-tip"),
    text([at([1.3, 0])[0], middle[1] + 4.5], "x", "italic"),
    text([middle[0] + 12, at([0, 1.2])[1] + 8], "y", "italic"),
  ];
}

/** The long axis and its angle from x. */
function angle(at, middle, aop) {
  const turn = (degrees) => [
    Math.cos((degrees * Math.PI) / 180),
    Math.sin((degrees * Math.PI) / 180),
  ];
  const along = turn(aop);
  const arc = Array.from({ length: 25 }, (_, i) =>
    at(turn((aop * i) / 24).map((each) => 0.34 * each)),
  );
  return [
    segment(
      at(along.map((each) => -1.08 * each)),
      at(along.map((each) => 1.08 * each)),
      "axis dashed",
    ),
    line(arc, "angle"),
  ];
}

/** Heads of arrows at both ends of linear light. @param {number[][]} curve as it is seen */
export function ends(curve, size = 13) {
  const half = Math.floor(curve.length / 2);
  const length = (i) => Math.hypot(...[0, 1].map((k) => curve[i][k] - curve[i + half][k]));
  let best = 0;
  for (let i = 1; i < half; i += 1) if (length(i) > length(best)) best = i;
  const [one, other] = [curve[best], curve[best + half]];
  const direction = [one[0] - other[0], one[1] - other[1]];
  const tip = Math.min(size, 0.45 * length(best));
  if (tip < 2) return [];
  return [
    head(one, direction, tip, "field-tip"),
    head(
      other,
      direction.map((each) => -each),
      tip,
      "field-tip",
    ),
  ];
}

/** Heads of arrows that say which way the field turns. */
function senses(curve) {
  const last = curve.length - 1;
  return [0.125, 0.625].map((share) => {
    const i = Math.round(share * last);
    const [before, after] = [curve[(i - 1 + last) % last], curve[(i + 1) % last]];
    return head(curve[i], [after[0] - before[0], after[1] - before[1]], 13, "field-tip");
  });
}

function nothing(light) {
  return isDark(light) ? "no light" : "no polarised part";
}

function caption(light) {
  const { handedness, dop } = light.ellipse;
  if (light.ellipse.points === null) return isDark(light) ? "dark" : "unpolarised";
  return dop < 0.9995
    ? `${handedness}, ${Number((100 * dop).toPrecision(3))} % polarised`
    : handedness;
}

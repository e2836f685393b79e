/** Curves of what comes out against a parameter, one panel for each kind of quantity. */

import { spread, wide } from "./labels.js";
import { dot, line, segment, show, text, widthOf } from "./svg.js";
import { degreeTicks, ofAxis, rangeOf, ticks } from "./ticks.js";
import { typeset } from "./units.js";
import { curveInWords } from "./words.js";

const TOP = 24;
const GAP = 32;
const BELOW = 46;

/**
 * @param {SVGElement} svg
 * @param {object} curve an answer's
 * @param {string[]} order of all quantities, by which each keeps its colour
 * @returns {(x: number) => number} the parameter at a place across, for pointing at it
 */
export function drawCurve(svg, curve, order) {
  const width = widthOf(svg);
  const panels = panelsOf(curve.lines);
  const tall = panels.length === 1 ? Math.min(360, Math.max(230, width * 0.42)) : 150;
  const right = width - 18 - Math.max(...curve.lines.map((each) => wide(each.name)));
  const ends = [Math.min(...curve.x), Math.max(...curve.x)];
  const left =
    18 +
    Math.max(
      28,
      ...panels.flatMap((panel) => heightsOf(panel, tall).map((each) => wide(ofAxis(each), 12))),
    );
  const across = (x) => left + ((x - ends[0]) / (ends[1] - ends[0] || 1)) * (right - left);
  const inDegrees = /\(deg\)/.test(curve.x_label);
  const marks = (inDegrees ? degreeTicks : ticks)(...ends, Math.max(3, (right - left) / 62));
  const height = TOP + panels.length * tall + (panels.length - 1) * GAP + BELOW;
  const parts = panels.flatMap((panel, i) => {
    const top = TOP + i * (tall + GAP);
    return panelOf(panel, { curve, across, marks, top, bottom: top + tall, left, right, order });
  });
  const bottom = height - BELOW;
  parts.push(...marks.map((each) => text([across(each), bottom + 18], ofAxis(each), "tick")));
  parts.push(text([(left + right) / 2, bottom + 38], curve.x_label, "axis-name"));
  show(svg, width, height, curveInWords(curve), ...parts);
  return (x) => ends[0] + ((x * width - left) / (right - left)) * (ends[1] - ends[0]);
}

/** Lines that share an axis: intensities, shares, angles. */
function panelsOf(lines) {
  const panels = new Map();
  for (const each of lines) {
    const kind = /^S[0-3]$/.test(each.name) ? "S" : each.unit === "" ? "share" : each.unit;
    panels.set(kind, [...(panels.get(kind) ?? []), each]);
  }
  return [...panels.values()];
}

function panelOf(lines, { curve, across, marks, top, bottom, left, right, order }) {
  const [low, high] = rangeOf(lines.flatMap((each) => each.values));
  const down = (y) => bottom - ((y - low) / (high - low)) * (bottom - top);
  const heights = heightsOf(lines, bottom - top);
  const parts = [
    ...marks.map((each) => segment([across(each), top], [across(each), bottom], "grid")),
    ...heights.map((each) =>
      segment([left, down(each)], [right, down(each)], each === 0 ? "grid zero" : "grid"),
    ),
    ...heights.map((each) => text([left - 8, down(each) + 4.5], ofAxis(each), "tick", "end")),
    text([left - 4, top - 7], nameOf(lines), "axis-name", "start"),
  ];
  if (curve.at !== null)
    parts.push(segment([across(curve.at), top], [across(curve.at), bottom], "present"));
  const last = lines.map(({ values }) => down(values.findLast((each) => each !== null) ?? low));
  const places = spread(last, 15, top + 4, bottom);
  lines.forEach((each, i) => {
    const k = Math.max(0, order.indexOf(each.name)) % 6;
    const points = each.values.map((value, j) =>
      broken(each, j) ? null : [across(curve.x[j]), down(value)],
    );
    parts.push(line(points, `curve l${k}`));
    const now = nearest(curve, each.values);
    if (now !== null) parts.push(dot([across(curve.at), down(now)], 4, `dot l${k}`));
    parts.push(segment([right + 2, last[i]], [right + 9, places[i]], `leader l${k}`));
    parts.push(text([right + 12, places[i] + 4.5], each.name, "strong", "start"));
  });
  return parts;
}

/** Where the axis of a panel is marked. */
function heightsOf(lines, tall) {
  const range = rangeOf(lines.flatMap((each) => each.values));
  return (lines[0].unit === "deg" ? degreeTicks : ticks)(...range, tall / 42);
}

function nameOf(lines) {
  const unit = lines[0].unit ? ` (${lines[0].unit})` : "";
  const named =
    lines.length === 1
      ? lines[0].label || lines[0].name
      : /^S/.test(lines[0].name)
        ? "Stokes parameters"
        : lines[0].unit === "deg"
          ? "angles"
          : "shares";
  return typeset(named) + unit;
}

/** A gap, where there is no value or an angle starts anew. */
function broken({ values, unit }, i) {
  if (values[i] === null) return true;
  const before = values[i - 1];
  return unit === "deg" && i > 0 && before !== null && Math.abs(values[i] - before) > 90;
}

/** The value at the present place, between its neighbours. */
function nearest({ x, at }, values) {
  const last = x.length - 1;
  if (at === null || last < 1 || at < Math.min(x[0], x[last]) || at > Math.max(x[0], x[last]))
    return null;
  const i = Math.min(last - 1, Math.floor(((at - x[0]) / (x[last] - x[0] || 1)) * last));
  if (values[i] === null || values[i + 1] === null) return null;
  return values[i] + ((values[i + 1] - values[i]) * (at - x[i])) / (x[i + 1] - x[i] || 1);
}

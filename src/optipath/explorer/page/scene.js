/** The path in space: elements, rays, planes of incidence, frames, ellipses and angles. */

import { along, around, placed } from "./labels.js";
import { ends } from "./ellipse.js";
import { plus, projected } from "./projection.js";
import { glyph, outlineOf } from "./glyphs.js";
import { head, line, segment, show, text, widthOf } from "./svg.js";
import { typeset } from "./units.js";
import { sceneInWords } from "./words.js";

export const SCENE_VIEW = [-55, 24, 1];

/** Half as wide as a surface, against a usual ray. */
const GLYPH = 0.16;

/**
 * @param {SVGElement} svg
 * @param {object} scene
 * @param {number[]} view azimuth, elevation and nearness
 * @param {Set<string>} parts which of "planes", "frames", "ellipses", "angles", "names" are drawn
 */
export function drawScene(svg, scene, view, parts) {
  const width = widthOf(svg);
  const height = heightOf(scene, width);
  const at = fitted(scene, view, width, height);
  const size = sizeOf(scene);
  const things = [];
  const labels = [];
  const add = (points, ...drawn) => things.push([mean(points.map((each) => each[2])), drawn]);
  if (parts.has("planes")) {
    for (const points of scene.planes.map(({ corners }) => corners.map(at))) {
      things.push([Math.min(...points.map((each) => each[2])) - 1, [line(points, "plane", true)]]);
    }
  }
  for (const ray of scene.rays) drawRay(ray, at, add, parts);
  for (const node of scene.nodes) {
    add([at(node.at)], ...glyph(node, at, GLYPH * size));
    if (parts.has("names")) labels.push({ at: at(node.at), words: node.name, look: "strong" });
  }
  if (parts.has("frames"))
    for (const each of scene.frames) labels.push(...drawFrame(each, at, add, 0.13 * size));
  if (parts.has("angles")) {
    for (const each of scene.angles) {
      const arc = each.arc.map(at);
      if (arc.length > 1) add(arc, line(arc, "angle"));
      labels.push({ at: at(each.at), words: typeset(each.text), look: "angle-name" });
    }
  }
  things.sort((one, other) => one[0] - other[0]);
  show(
    svg,
    width,
    height,
    sceneInWords(scene),
    ...things.flatMap(([, drawn]) => drawn),
    ...named(labels, scene, at, [width, height], parts),
  );
}

const mean = (numbers) => numbers.reduce((sum, each) => sum + each, 0) / numbers.length;

/** How long a usual ray is, after which marks are sized. */
function sizeOf(scene) {
  const lengths = scene.rays
    .map(({ from, to }) => Math.hypot(...plus(to, from, -1)))
    .filter((each) => each > 0);
  lengths.sort((a, b) => a - b);
  return lengths[Math.floor(lengths.length / 2)] ?? 1;
}

/** As tall as the scene is when seen as at first, so that turning it changes nothing. */
function heightOf(scene, width) {
  const [left, top, right, bottom] = extent(scene, SCENE_VIEW);
  const wanted = 90 + ((width - 120) * (bottom - top)) / Math.max(right - left, 1e-9);
  return Math.round(Math.max(Math.min(260, width), Math.min(0.62 * width, wanted, 640)));
}

/** @returns {number[]} left, top, right and bottom of all that is drawn */
function extent(scene, view) {
  const points = [
    ...scene.rays.flatMap(({ from, to }) => [from, to]),
    ...scene.nodes.flatMap((each) => outlineOf(each, GLYPH * sizeOf(scene))),
    ...scene.rays.flatMap(ellipseOf),
    ...scene.angles.flatMap((each) => each.arc),
    ...scene.planes.flatMap((each) => each.corners),
  ].map(projected(view));
  const side = (k) => points.map((each) => each[k]);
  return [Math.min(...side(0)), Math.min(...side(1)), Math.max(...side(0)), Math.max(...side(1))];
}

/** A projection that brings all that is drawn into the picture. */
function fitted(scene, view, width, height) {
  const project = projected(view);
  const [left, top, right, bottom] = extent(scene, view);
  const size = sizeOf(scene);
  const room = [width - 110, height - 80];
  const scale =
    view[2] *
    Math.min(room[0] / Math.max(right - left, size), room[1] / Math.max(bottom - top, size));
  const middle = [(left + right) / 2, (top + bottom) / 2];
  return (point) => {
    const [x, y, near] = project(point);
    return [
      width / 2 + scale * (x - middle[0]),
      height / 2 + scale * (y - middle[1]),
      near * scale,
    ];
  };
}

function drawRay(ray, at, add, parts) {
  const [from, to] = [at(ray.from), at(ray.to)];
  const direction = [to[0] - from[0], to[1] - from[1]];
  const kind = ray.leaves ? "leaves" : ray.intensity === 0 ? "dark" : ray.tap ? "tap" : "";
  const look = `ray ${kind}`;
  const share = ray.ellipse !== null && parts.has("ellipses") ? 0.76 : 0.56;
  const tip = from.map((each, k) => each + (to[k] - each) * (ray.leaves ? 1 : share));
  add([from, to], segment(from, to, look));
  if (Math.hypot(...direction) > 14)
    add([from, to], head(tip, direction, 9, ray.leaves ? "ray-tip leaves" : "ray-tip"));
  if (!parts.has("ellipses") || ray.ellipse === null || ray.leaves) return;
  const curve = ellipseOf(ray).map(at);
  add(curve, line(curve, "field fill", true), line(curve, "field thin", true));
  add(curve, ...tipsOf(ray.ellipse, curve));
}

/** The points of the ellipse of a ray, in space; none where there is none. */
function ellipseOf({ from, to, ellipse, leaves }) {
  if (ellipse === null || leaves) return [];
  const middle = plus(from, plus(to, from, -1), 0.5);
  return ellipse.map((each) => plus(middle, each));
}

/** Which way the field turns; both ends of a field that does not; nothing where it is seen edge on. */
function tipsOf(ellipse, curve) {
  const lengths = ellipse.map((each) => Math.hypot(...each));
  const [wide, narrow] = [Math.max(...lengths), Math.min(...lengths)];
  if (narrow < 0.01 * wide) return ends(curve, 7);
  const i = Math.floor(curve.length / 8);
  const step = [curve[i + 1][0] - curve[i - 1][0], curve[i + 1][1] - curve[i - 1][1]];
  return isSeenFlat(curve) || Math.hypot(...step) < 0.5 ? [] : [head(curve[i], step, 7, "field-tip")];
}

/** Whether an ellipse is too narrow, as it is seen, for a head of an arrow. */
function isSeenFlat(curve) {
  const area = curve.reduce(
    (sum, [x, y], i) => sum + x * curve.at(i - 1)[1] - y * curve.at(i - 1)[0],
    0,
  );
  const across = Math.max(...curve.map(([x, y]) => Math.hypot(x - curve[0][0], y - curve[0][1])));
  return Math.abs(area) / 2 < 4 * across;
}

const AXES = ["x", "y", "z"];

function drawFrame(frame, at, add, size) {
  const origin = at(frame.at);
  return AXES.map((axis) => {
    const tip = at(plus(frame.at, frame[axis], size));
    add([origin, tip], segment(origin, tip, `frame-axis f${axis}`));
    add([tip], head(tip, [tip[0] - origin[0], tip[1] - origin[1]], 6, `frame-tip f${axis}`));
    return { at: tip, words: axis, look: "small italic", size: 11, near: true };
  });
}

function named(labels, scene, at, room, parts) {
  const outlines = scene.nodes.map((node) => outlineOf(node, GLYPH * sizeOf(scene)));
  const obstacles = [
    ...[...outlines, ...(parts.has("ellipses") ? scene.rays.map(ellipseOf) : [])]
      .filter((points) => points.length > 0)
      .map((points) => around(points.map(at))),
    ...scene.rays.filter((each) => !each.leaves).flatMap(({ from, to }) => along(at(from), at(to))),
  ];
  const order = [...labels].sort((one, other) => (one.near ? 1 : 0) - (other.near ? 1 : 0));
  return placed(order, room, obstacles).flatMap(({ x, y, far }, i) => {
    const { words, look, at: point, near } = order[i];
    if (near && far) return [];
    const lead = far ? [segment(point, [x, y - 4], "lead")] : [];
    return [...lead, text([x, y], words, `halo ${look}`)];
  });
}

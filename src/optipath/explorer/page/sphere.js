/** The Poincaré sphere: circular light at the poles, linear light on the equator. */

import { along as boxes, placed } from "./labels.js";
import { projected } from "./projection.js";
import { dot, line, segment, show, text } from "./svg.js";
import { sphereInWords } from "./words.js";

const SIZE = 300;
const RADIUS = 108;
const MIDDLE = [SIZE / 2, SIZE / 2];

export const SPHERE_VIEW = [32, 22];

/**
 * @param {SVGElement} svg
 * @param {number[]} view azimuth and elevation of the eye
 * @param {string} name of the detector
 * @param {object} light its answer
 * @param {object[]} along the light on each link
 */
export function drawSphere(svg, view, name, light, along) {
  const project = projected(view);
  const at = (point) => {
    const [x, y, near] = project(point);
    return [MIDDLE[0] + RADIUS * x, MIDDLE[1] + RADIUS * y, near];
  };
  const parts = [dot(MIDDLE, RADIUS, "sphere"), ...circles(at), ...axes(at)];
  const way = steps(along);
  const points = along.filter((each) => each.poincare !== null).map((each) => at(each.poincare));
  parts.push(...way.map((each) => trail(each, at)));
  parts.push(
    ...points.map((each) => dot(each, 3.2, each[2] < 0 ? "trail-mark behind" : "trail-mark")),
  );
  const obstacles = points.map(([x, y]) => [x - 4, y - 4, x + 4, y + 4]);
  if (light.poincare !== null) {
    const here = at(light.poincare);
    parts.push(segment(MIDDLE, here, "stem"), dot(here, 6.5, here[2] < 0 ? "mark behind" : "mark"));
    obstacles.push([here[0] - 7, here[1] - 7, here[0] + 7, here[1] + 7], ...boxes(MIDDLE, here));
  }
  parts.push(...names(at, light.poincare === null ? null : [name, at(light.poincare)], obstacles));
  show(svg, SIZE, SIZE, sphereInWords(along, name, light), ...parts);
}

function circles(at) {
  const ring = (point) => Array.from({ length: 73 }, (_, i) => at(point((i * Math.PI) / 36)));
  const rings = [
    [ring((t) => [Math.cos(t), Math.sin(t), 0]), "equator"],
    [ring((t) => [Math.cos(t), 0, Math.sin(t)]), "meridian"],
    [ring((t) => [0, Math.cos(t), Math.sin(t)]), "meridian"],
  ];
  return rings.flatMap(([points, look]) => [
    line(
      seen(points, (near) => near < 0),
      `${look} behind`,
    ),
    line(
      seen(points, (near) => near >= 0),
      look,
    ),
  ]);
}

/** The points on one side, with gaps. */
function seen(points, side) {
  return points.map((each, i) => {
    const around = [points[i - 1] ?? each, each, points[i + 1] ?? each];
    return around.some(([, , near]) => side(near)) ? each : null;
  });
}

const AXES = { S1: [1, 0, 0], S2: [0, 1, 0], S3: [0, 0, 1] };

function axes(at) {
  return Object.values(AXES).map((axis) =>
    segment(at(axis.map((each) => -each)), at(axis.map((each) => 1.16 * each)), "helper"),
  );
}

function names(at, here, obstacles) {
  const axes = Object.entries(AXES).map(([words, axis]) => ({
    words,
    at: at(axis.map((each) => 1.17 * each)),
  }));
  const labels = here === null ? axes : [{ words: here[0], at: here[1] }, ...axes];
  return placed(labels, [SIZE, SIZE], obstacles).map(({ x, y }, i) => {
    const { words } = labels[i];
    return text([x, y], words, words in AXES ? "faint italic" : "strong");
  });
}

/** Pairs of states one after the other on the way. */
function steps(along) {
  const there = along.filter((each) => each.poincare !== null);
  const pairs = there.flatMap((each) =>
    there
      .filter((next) => next.start === each.end && next !== each)
      .map((next) => [each.poincare, next.poincare]),
  );
  return pairs;
}

/** The short way on the sphere, or through it where light is partly polarised. */
function trail([from, to], at) {
  const size = (point) => Math.hypot(...point);
  const [one, other] = [size(from), size(to)];
  const points = Array.from({ length: 17 }, (_, i) => {
    const share = i / 16;
    const straight = from.map((each, k) => each * (1 - share) + to[k] * share);
    const length = size(straight);
    const wanted = one * (1 - share) + other * share;
    return at(length > 0.02 ? straight.map((each) => (each * wanted) / length) : straight);
  });
  return line(points, "trail");
}

/** The power along the path, as bands whose width is the power. */

import { flowOf, lossesOf } from "./flow.js";
import { overlap, spread, wide } from "./labels.js";
import { segment, shape, show, text, widthOf } from "./svg.js";
import { typeset } from "./units.js";
import { energyInWords } from "./words.js";

const STEP = 66;
const BAR = 5;
const TOP = 14;
const BELOW = 30;

/** @param {SVGElement} svg @param {object} energy an answer's */
export function drawEnergy(svg, energy) {
  const width = widthOf(svg);
  const { nodes, layers, bands } = flowOf(energy);
  const height = TOP + BELOW + (layers.length - 1) * STEP + BAR;
  const lost = [...nodes.keys()].flatMap((name) => lossesOf(name, energy));
  const aside = Math.min(0.5 * width, Math.max(40, ...lost.map((each) => wide(labelOf(each)) + 44)));
  const scale = placeNodes(nodes, layers, width - aside);
  const parts = bands.flatMap((each) => bandOf(each, nodes, scale));
  const labels = [];
  const bars = [];
  for (const [name, node] of nodes) {
    for (const each of lossesOf(name, energy)) parts.push(lossOf(each, node, scale, labels));
    const long = Math.max(2, node.power * scale);
    bars.push(shape("rect", { x: node.x, y: node.y, width: long, height: BAR, class: "bar-of" }));
    bars.push(text([node.x - 7, node.y + 7], name, "strong halo", "end"));
  }
  parts.push(...bars, ...lossNames(labels, height), ...bandNames(bands), ...endNames(energy, nodes));
  show(svg, width, height, energyInWords(energy), ...parts);
}

const labelOf = ({ name, text: words }) => typeset(`${name} ${words}`);

/** Bars of a layer stand side by side, their names before them. Returns how wide a power is. */
function placeNodes(nodes, layers, room) {
  const names = (layer) => layer.map((name) => wide(name) + 18);
  const power = (layer) => layer.reduce((total, name) => total + nodes.get(name).power, 0);
  const left = Math.max(...layers.map((layer) => names(layer)[0]));
  const free = (layer) => room - left - names(layer).slice(1).reduce((total, each) => total + each, 0);
  const scales = layers.filter((layer) => power(layer) > 0).map((layer) => Math.max(24, free(layer)) / power(layer));
  const scale = scales.length > 0 ? Math.min(...scales) : 0;
  layers.forEach((layer, i) => {
    const gaps = names(layer);
    let x = left - gaps[0];
    layer.forEach((name, k) => {
      x += gaps[k];
      Object.assign(nodes.get(name), { x, y: TOP + i * STEP, above: 0, below: 0 });
      x += nodes.get(name).power * scale;
    });
  });
  return scale;
}

/** Down from below one bar to another's upper side; or back up between the same sides. */
function bandOf(band, nodes, scale) {
  const [upper, lower] = band.back ? [nodes.get(band.to), nodes.get(band.from)] : [nodes.get(band.from), nodes.get(band.to)];
  const wideBand = Math.max(0, band.power ?? 0) * scale;
  const [a, b, top, bottom] = [upper.x + upper.below, lower.x + lower.above, upper.y + BAR, lower.y];
  upper.below += wideBand;
  lower.above += wideBand;
  Object.assign(band, { middle: [(a + b + wideBand) / 2, (top + bottom) / 2], wide: wideBand });
  if (wideBand < 0.6) return [segment([a, top], [b, bottom], "band thin")];
  const half = (top + bottom) / 2;
  const side = (from, to) => `${from} ${half} ${to} ${half} ${to}`;
  const d = `M${a} ${top}C${side(a, b)} ${bottom}H${b + wideBand}C${side(b + wideBand, a + wideBand)} ${top}Z`;
  return [shape("path", { d, class: band.back ? "band back" : "band" })];
}

/** A band that turns away to the right and ends. */
function lossOf(loss, node, scale, labels) {
  const wideLoss = Math.max(0, loss.power ?? 0) * scale;
  const [a, top] = [node.x + node.below, node.y + BAR];
  node.below += wideLoss;
  const drawn = Math.max(wideLoss, 0.8);
  const thick = Math.min(drawn, STEP * 0.4);
  const end = Math.max(node.x + node.power * scale, node.x + node.below) + 16;
  const y = top + 10;
  labels.push({ x: end + 2, y: y + thick / 2, words: labelOf(loss) });
  const d =
    `M${a} ${top}C${a} ${y + thick} ${a + drawn / 2} ${y + thick} ${end} ${y + thick}` +
    `V${y}C${a + drawn} ${y} ${a + drawn} ${y} ${a + drawn} ${top}Z`;
  return shape("path", { d, class: `loss ${loss.kind}` });
}

function lossNames(labels, height) {
  const heights = spread(labels.map((each) => each.y), 16, 12, height - 8);
  return labels.flatMap(({ x, y, words }, i) => [
    segment([x, y], [x + 7, heights[i]], "lead"),
    text([x + 10, heights[i] + 4.5], words, "small halo", "start"),
  ]);
}

/** The power of a band, written where there is room for it. */
function bandNames(bands) {
  const boxes = [];
  return bands.flatMap((each) => {
    const words = typeset(each.text);
    const half = wide(words) / 2;
    const [x, y] = each.middle;
    const box = [x - half - 2, y - 8, x + half + 2, y + 8];
    if (each.wide < 14 || boxes.some((other) => overlap(box, other) > 0)) return [];
    boxes.push(box);
    return [text([x, y + 4], words, "small halo")];
  });
}

function endNames(energy, nodes) {
  return energy.ends
    .filter((each) => nodes.has(each.node))
    .map((each) => text([nodes.get(each.node).x, nodes.get(each.node).y + BAR + 16], typeset(each.text), "strong halo", "start"));
}

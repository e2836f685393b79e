/** The power along the path, as bands whose width is the power. */

import { flowOf, lossesOf } from "./flow.js";
import { spread, wide } from "./labels.js";
import { segment, shape, show, text, widthOf } from "./svg.js";
import { typeset } from "./units.js";
import { energyInWords } from "./words.js";

const STEP = 66;
const BAR = 5;
const MARGIN = 14;

/** @param {SVGElement} svg @param {object} energy an answer's */
export function drawEnergy(svg, energy) {
  const width = widthOf(svg);
  const { nodes, layers, bands } = flowOf(energy);
  const height = 2 * MARGIN + 22 + (layers.length - 1) * STEP + BAR;
  const least = Math.max(...layers.map((names) => names.reduce((sum, name) => sum + nodes.get(name).power, 0)), 1e-300);
  const most = Math.max(...layers.map((names) => names.length));
  const names = Math.max(...[...nodes.keys()].map((name) => wide(name))) + 14;
  const losses = Math.max(90, ...[...nodes.keys()].flatMap((name) => lossesOf(name, energy)).map((each) => wide(labelOf(each)) + 34));
  const room = Math.max(80, width - names - Math.min(losses, 0.5 * width));
  const scale = (room - 26 * (most - 1)) / least;
  placeNodes(nodes, layers, scale, names, room);
  const parts = bands.flatMap((each) => bandOf(each, nodes, scale));
  const labels = [];
  for (const [name, node] of nodes) {
    for (const each of lossesOf(name, energy)) parts.push(...lossOf(each, node, scale, labels));
    parts.push(shape("rect", { x: node.x, y: node.y, width: Math.max(2, node.power * scale), height: BAR, class: "bar-of" }));
    parts.push(text([node.x - 7, node.y + 9], name, "strong halo", "end"));
  }
  const heights = spread(labels.map((each) => each.y), 16, 14, height - 6);
  labels.forEach((each, i) => {
    parts.push(segment([each.x, each.y], [each.x + 8, heights[i]], "lead"));
    parts.push(text([each.x + 11, heights[i] + 4.5], each.words, "small halo", "start"));
  });
  parts.push(...bandNames(bands, nodes), ...endNames(energy, nodes));
  show(svg, width, height, energyInWords(energy), ...parts);
}

const labelOf = ({ name, text: words }) => typeset(`${name} ${words}`);

/** Bars of a layer stand side by side about the middle of where their light comes from. */
function placeNodes(nodes, layers, scale, left, room) {
  layers.forEach((names, layer) => {
    const wanted = names.reduce((sum, name) => sum + nodes.get(name).power * scale, 0);
    const gap = names.length > 1 ? Math.min(90, Math.max(20, (room - wanted) / (names.length - 1))) : 0;
    let x = left;
    for (const name of names) {
      Object.assign(nodes.get(name), { x, y: MARGIN + layer * STEP, into: 0, out: 0 });
      x += nodes.get(name).power * scale + gap;
    }
  });
}

function bandOf(band, nodes, scale) {
  const [from, to] = [nodes.get(band.from), nodes.get(band.to)];
  const wideBand = Math.max(0, band.power ?? 0) * scale;
  const [a, b] = [from.x + from.out, to.x + to.into];
  from.out += wideBand;
  to.into += wideBand;
  band.middle = [(a + b + wideBand) / 2, (from.y + BAR + to.y) / 2];
  band.wide = wideBand;
  if (wideBand < 0.6) return [segment([a, from.y + BAR], [b, to.y], "band thin")];
  const [top, bottom] = [from.y + BAR, to.y];
  const bend = band.back ? -STEP * 0.6 : (bottom - top) / 2;
  const d =
    `M${a} ${top}C${a} ${top + Math.abs(bend)} ${b} ${bottom - Math.abs(bend)} ${b} ${bottom}` +
    `L${b + wideBand} ${bottom}C${b + wideBand} ${bottom - Math.abs(bend)} ${a + wideBand} ${top + Math.abs(bend)} ${a + wideBand} ${top}Z`;
  return [shape("path", { d, class: band.back ? "band back" : "band" })];
}

/** A band that turns away to the right and ends. */
function lossOf(loss, node, scale, labels) {
  const wideLoss = Math.max(0, loss.power ?? 0) * scale;
  const [a, top] = [node.x + node.out, node.y + BAR];
  node.out += wideLoss;
  const drawn = Math.max(wideLoss, 0.8);
  const thick = Math.min(drawn, STEP * 0.45);
  const end = node.x + Math.max(node.power * scale, node.out) + 16;
  const y = top + 12;
  labels.push({ x: end + 2, y: y + thick / 2, words: labelOf(loss) });
  const d =
    `M${a} ${top}C${a} ${y + thick} ${a + drawn / 2} ${y + thick} ${end} ${y + thick}` +
    `L${end} ${y}C${a + drawn} ${y} ${a + drawn} ${y} ${a + drawn} ${top}Z`;
  return [shape("path", { d, class: `loss ${loss.kind}` })];
}

/** The power of a band, written where it is wide enough. */
function bandNames(bands, nodes) {
  void nodes;
  return bands.filter((each) => each.wide > wide(typeset(each.text)) + 6).map((each) => text([each.middle[0], each.middle[1] + 4], typeset(each.text), "small halo"));
}

function endNames(energy, nodes) {
  return energy.ends
    .filter((each) => nodes.has(each.node))
    .map((each) => {
      const node = nodes.get(each.node);
      return text([node.x + Math.max(2, node.power * 1e-9), node.y + BAR + 17], typeset(each.text), "strong halo", "start");
    });
}

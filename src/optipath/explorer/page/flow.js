/** Where power goes: elements in layers, one below the other, in the order of the light. */

const nodeOf = (port) => port.split(".")[0];

const sum = (list) => list.reduce((total, each) => total + Math.max(0, each.power ?? 0), 0);

/**
 * @param {object} energy an answer's
 * @returns {{nodes: Map<string, {layer: number, power: number}>, bands: object[], layers: string[][]}}
 *   `power`, by which a node is wide, is what goes in from above and back out there, or what goes
 *   out below and comes back in there; bands that lead back up are marked. A tap takes nothing.
 */
export function flowOf(energy) {
  const bands = energy.links.map((each) => ({ ...each, power: each.tap ? 0 : each.power, from: nodeOf(each.start), to: nodeOf(each.end) }));
  const names = [...new Set(bands.flatMap(({ from, to }) => [from, to]))];
  const closing = leadingBack(names, bands);
  for (const each of bands) each.back = closing.has(each);
  const layer = layersOf(names, bands.filter((each) => !each.back));
  const layers = [];
  for (const name of names) (layers[layer.get(name)] ??= []).push(name);
  order(layers, bands);
  const nodes = new Map(names.map((name) => [name, { layer: layer.get(name), power: across(name, bands, energy) }]));
  return { nodes, layers, bands };
}

/** Each node below all that it gets light from; a source just above what it lights. */
function layersOf(names, forth) {
  const layer = new Map(names.map((name) => [name, 0]));
  for (let round = 0; round < names.length; round += 1) {
    for (const { from, to } of forth) layer.set(to, Math.max(layer.get(to), layer.get(from) + 1));
  }
  for (const name of names) {
    const below = forth.filter((each) => each.from === name).map((each) => layer.get(each.to));
    const lit = forth.some((each) => each.to === name);
    if (!lit && below.length > 0) layer.set(name, Math.min(...below) - 1);
  }
  return layer;
}

/** Nodes of a layer in the order of the nodes that light them, so that bands cross little. */
function order(layers, bands) {
  layers.forEach((names, i) => {
    const place = (name) => {
      const above = bands.filter((each) => each.to === name && !each.back).map((each) => (layers[i - 1] ?? []).indexOf(each.from));
      const known = above.filter((each) => each >= 0);
      return known.length > 0 ? sum(known.map((power) => ({ power }))) / known.length : names.length;
    };
    const places = new Map(names.map((name) => [name, place(name)]));
    names.sort((one, other) => places.get(one) - places.get(other));
  });
}

/** Bands that close a round, found by going in depth from the sources. */
function leadingBack(names, bands) {
  const back = new Set();
  const state = new Map();
  const visit = (name) => {
    state.set(name, "open");
    for (const band of bands.filter((each) => each.from === name)) {
      if (state.get(band.to) === "open") back.add(band);
      else if (!state.has(band.to)) visit(band.to);
    }
    state.set(name, "done");
  };
  const entered = new Set(bands.map((each) => each.to));
  for (const name of [...names.filter((each) => !entered.has(each)), ...names]) if (!state.has(name)) visit(name);
  return back;
}

function across(name, bands, energy) {
  const some = (end, back) => sum(bands.filter((each) => each[end] === name && each.back === back));
  const above = some("to", false) + some("from", true);
  return Math.max(above, some("from", false) + some("to", true) + sum(lossesOf(name, energy)));
}

/** What does not go on from an element: taken by it, or leaving without a link. */
export function lossesOf(name, energy) {
  const leaves = energy.leaves.filter((each) => nodeOf(each.name) === name);
  const taken = energy.taken.filter((each) => each.node === name && each.power > 0);
  return [
    ...leaves.map((each) => ({ ...each, kind: "leaves" })),
    ...taken.map((each) => ({ ...each, kind: "taken", name: `taken by ${name}` })),
  ];
}

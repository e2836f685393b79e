/** Where power goes: elements in layers, one below the other, in the order of the light. */

const nodeOf = (port) => port.split(".")[0];

/**
 * @param {object} energy an answer's
 * @returns {{nodes: Map<string, {layer: number, power: number}>, bands: object[], layers: string[][]}}
 *   bands go from a node to a node below; those that lead back are marked
 */
export function flowOf(energy) {
  const bands = energy.links.map((each) => ({ ...each, from: nodeOf(each.start), to: nodeOf(each.end) }));
  const names = [...new Set(bands.flatMap(({ from, to }) => [from, to]))];
  const back = leadingBack(names, bands);
  const layer = new Map(names.map((name) => [name, 0]));
  const forth = bands.filter((each) => !back.has(each));
  for (let round = 0; round < names.length; round += 1) {
    for (const { from, to } of forth) layer.set(to, Math.max(layer.get(to), layer.get(from) + 1));
  }
  const layers = [];
  for (const name of names) (layers[layer.get(name)] ??= []).push(name);
  const nodes = new Map(names.map((name) => [name, { layer: layer.get(name), power: through(name, bands, energy) }]));
  return { nodes, layers, bands: bands.map((each) => ({ ...each, back: back.has(each) })) };
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

/** The power that goes into or out of an element, whichever is more. */
function through(name, bands, energy) {
  const sum = (list) => list.reduce((total, each) => total + Math.max(0, each.power ?? 0), 0);
  const into = sum(bands.filter((each) => each.to === name));
  return Math.max(into, sum(bands.filter((each) => each.from === name)) + sum(lossesOf(name, energy)));
}

/** What does not go on from an element: taken by it, or leaving without a link. */
export function lossesOf(name, energy) {
  const leaves = energy.leaves.filter((each) => nodeOf(each.name) === name);
  const taken = energy.taken.filter((each) => each.node === name);
  return [
    ...leaves.map((each) => ({ ...each, kind: "leaves" })),
    ...taken.map((each) => ({ ...each, kind: "taken", name: `taken by ${name}` })),
  ];
}

/**
 * What the page shows, as one value: kept in a history for undo and written into the address.
 *
 * @typedef {{x: string|null, from: string, to: string, y: string[]}} Curve
 * @typedef {{sphere: number[]|null, scene: number[]|null}} Views
 * @typedef {{preset: string, case: string|null, places: Object<string, string>,
 *   values: Object<string, string>, detector: string|null, curve: Curve, views: Views}} State
 */

export const CURVE = { x: null, from: "", to: "", y: ["S0", "S1", "S2", "S3"] };

/** @param {string} preset @returns {State} */
export function newState(preset) {
  return {
    preset,
    case: null,
    places: {},
    values: {},
    detector: null,
    curve: CURVE,
    views: { sphere: null, scene: null },
  };
}

/** A state with one entry of one of its parts set, or left out where the entry is null. */
export function withEntry(state, part, name, entry) {
  const entries = { ...state[part] };
  if (entry === null) delete entries[name];
  else entries[name] = entry;
  return { ...state, [part]: entries };
}

const WAVELENGTH = "wavelength";

/** Whether materials are given by name, which have n and k at a wavelength only. */
function asksWavelength(state, about) {
  const given = about.parameters.filter((each) => each.materials && each.name in state.values);
  return given.some((each) => !/^[\s(]*[-+]?\.?\d/.test(state.values[each.name]));
}

/** Whether a parameter has a part: a wavelength that is only offered has it with materials. */
export function takesPart(parameter, state, about) {
  return !parameter.offered || asksWavelength(state, about);
}

/** A state without a wavelength that nothing asks for. */
export function withoutIdle(state, about) {
  const idle = about.parameters.some((each) => each.offered);
  return idle && !asksWavelength(state, about)
    ? withEntry(state, "values", WAVELENGTH, null)
    : state;
}

/** @param {State} state @returns {string} the part of an address behind its "#" */
export function toHash(state) {
  const words = new URLSearchParams({ preset: state.preset });
  if (state.case !== null) words.set("case", state.case);
  for (const [name, word] of Object.entries(state.places)) words.set(`place.${name}`, word);
  for (const [name, text] of Object.entries(state.values)) words.set(`value.${name}`, text);
  if (state.detector !== null) words.set("detector", state.detector);
  const { x, from, to, y } = state.curve;
  if (x !== null) words.set("x", x);
  if (from !== "") words.set("from", from);
  if (to !== "") words.set("to", to);
  if (y.join() !== CURVE.y.join()) words.set("y", y.join(","));
  for (const [name, view] of Object.entries(state.views)) {
    if (view !== null) words.set(`view.${name}`, view.join(","));
  }
  return words.toString();
}

/** @param {string} hash @returns {State|null} null where it names no preset */
export function fromHash(hash) {
  const words = new URLSearchParams(hash.replace(/^#/, ""));
  const preset = words.get("preset");
  if (!preset) return null;
  const state = newState(preset);
  state.case = words.get("case");
  state.detector = words.get("detector");
  state.curve = {
    x: words.get("x"),
    from: words.get("from") ?? "",
    to: words.get("to") ?? "",
    y: words.has("y") ? words.get("y").split(",").filter(Boolean) : CURVE.y,
  };
  for (const [key, text] of words) {
    const [part, ...rest] = key.split(".");
    const name = rest.join(".");
    if (part === "place" && name) state.places[name] = text;
    if (part === "value" && name) state.values[name] = text;
    if (part === "view" && name in state.views) state.views[name] = viewOf(text);
  }
  return state;
}

function viewOf(text) {
  const numbers = text.split(",").map(Number);
  return numbers.length >= 2 && numbers.every(Number.isFinite) ? numbers : null;
}

const STEPS = 200;

/** States one after another; changes under one key, as of one drag of a slider, are one step. */
export class History {
  /** @param {State} first */
  constructor(first) {
    this.states = [first];
    this.at = 0;
    this.key = null;
  }

  get now() {
    return this.states[this.at];
  }

  get canUndo() {
    return this.at > 0;
  }

  get canRedo() {
    return this.at < this.states.length - 1;
  }

  /** @param {State} state @param {string|null} key */
  push(state, key = null) {
    const end = key !== null && key === this.key && this.canUndo ? this.at : this.at + 1;
    this.states = [...this.states.slice(Math.max(0, end - STEPS), end), state];
    this.at = this.states.length - 1;
    this.key = key;
  }

  /** What comes next is a step of its own. */
  settle() {
    this.key = null;
  }

  /** The present state, changed without a step. @param {State} state */
  replace(state) {
    this.states[this.at] = state;
  }

  undo() {
    if (this.canUndo) this.at -= 1;
    this.key = null;
    return this.now;
  }

  redo() {
    if (this.canRedo) this.at += 1;
    this.key = null;
    return this.now;
  }
}

/** The page: what is set goes to the library, and what comes back is drawn. */

import { get, newest, post } from "./api.js";
import { Controls } from "./controls.js";
import { CurveChoice } from "./curve_choice.js";
import { by, debounced, option, say } from "./dom.js";
import { Texts, addSaving, copy } from "./export.js";
import { Pictures } from "./pictures.js";
import { History, fromHash, newState, toHash, withEntry, withoutIdle } from "./state.js";
import { chooseTheme } from "./theme.js";
import { typeset } from "./units.js";

/** What is open: the description of the preset, its controls, the history. */
const open = { about: null, key: null, controls: null, curve: null, history: null, answer: null };
const pictures = new Pictures(turned);
const texts = new Texts(() => (open.about === null ? null : question(open.history.now)));
const refreshTexts = debounced(() => texts.refresh(), 400);
const writeAddress = debounced(() => history.replaceState(null, "", `#${toHash(open.history.now)}`), 120);

const WANTED = ["scene", "energy", "explanation"];

const keyOf = (state) => JSON.stringify([state.preset, state.places]);

/** The part of a state that the server is told. */
function question(state) {
  const { preset, places, values, detector } = state;
  return { preset, case: state.case, places, values, detector, curve: open.curve?.asked(state) ?? null };
}

/** Open the preset where it is another one, and trace. */
async function ask(state) {
  const key = keyOf(state);
  let about = open.about;
  if (key !== open.key) {
    about = await post("open", { preset: state.preset, places: state.places });
    if (about.faults?.length) return about;
    adopt(about, key);
  }
  const answer = await post("trace", { ...question(state), want: WANTED });
  const bare = open.answer === null && answer.faults.length > 0;
  return bare ? { ...answer, before: await defaults(state) } : answer;
}

/** What a preset shows by itself, for an address with values that cannot be. */
async function defaults({ preset }) {
  const answer = await post("trace", { preset, want: WANTED });
  return answer.faults.length > 0 ? null : answer;
}

/** Take up a preset: its controls take the place of those before. */
function adopt(about, key) {
  const known = open.about?.preset === about.preset ? document.activeElement?.id : "";
  Object.assign(open, { about, key, answer: null });
  const actions = { set, settle: () => open.history.settle(), place };
  open.controls = new Controls(by("controls"), about, actions);
  open.curve = new CurveChoice(about, (change, step) =>
    go({ ...open.history.now, curve: { ...open.history.now.curve, ...change } }, step),
  );
  if (known) by(known)?.focus();
  by("preset").value = about.preset;
  say(by("description"), about.description);
}

let forced = false;

function show(state, answer) {
  const faults = answer.faults ?? [];
  const rest = open.controls?.complain(faults) ?? faults;
  const ofCurve = rest.filter((each) => each.field?.startsWith("curve"));
  say(by("curve-fault"), ofCurve.map((each) => each.sentence).join(" "));
  say(by("fault"), rest.filter((each) => !ofCurve.includes(each)).map((each) => each.sentence).join(" "));
  const stale = faults.length > 0;
  if (answer.before) take(state, answer.before);
  document.body.classList.toggle("stale", stale && open.answer !== null);
  by("stale").hidden = !(stale && open.answer !== null);
  open.curve?.update(state);
  if (stale) {
    open.controls?.choose(state);
    return;
  }
  take(state, answer);
  forced = false;
  const found = open.about.cases.find((each) => each.name === state.case);
  say(by("note"), found?.note ? typeset(found.note) : "");
  say(by("told"), typeset((answer.notes ?? []).join(" ")));
  refreshTexts();
}

/** Show what an answer without faults says. */
function take(state, answer) {
  open.answer = answer;
  open.controls.update(state, answer.values, forced);
  pictures.show(state, answer, open.about);
}

const request = newest(ask, show);

/** Go to a state: a step that can be undone. @param {string|null} key of changes that are one step */
function go(state, key) {
  if (toHash(state) === toHash(open.history.now)) return;
  open.history.push(state, key);
  shown();
}

function shown() {
  by("undo").disabled = !open.history.canUndo;
  by("redo").disabled = !open.history.canRedo;
  writeAddress();
  request(open.history.now);
}

function set(name, text, key) {
  go(withoutIdle(withEntry(open.history.now, "values", name, text), open.about), key);
}

function place(name, word) {
  const usual = open.about.choices.find((each) => each.name === name).default === word;
  go(withEntry(open.history.now, "places", name, usual ? null : word), null);
}

/** A view that has been turned is kept in the address, but is no step. */
function turned(name, view) {
  const now = open.history.now;
  open.history.replace({ ...now, views: { ...now.views, [name]: view && view.map((each) => Math.round(each * 100) / 100) } });
  writeAddress();
}

/** Show the state that undo or redo has come to. */
function step() {
  forced = true;
  pictures.view(open.history.now);
  shown();
}

function undo() {
  open.history.undo();
  step();
}

function redo() {
  open.history.redo();
  step();
}

function listen() {
  by("preset").addEventListener("change", () => go(newState(by("preset").value), null));
  by("case").addEventListener("change", () => {
    forced = true;
    go({ ...open.history.now, case: by("case").value || null, values: {} }, null);
  });
  by("detector").addEventListener("change", () => go({ ...open.history.now, detector: by("detector").value }, null));
  by("undo").addEventListener("click", undo);
  by("redo").addEventListener("click", redo);
  by("reset").addEventListener("click", () => {
    forced = true;
    go({ ...open.history.now, values: {}, places: {} }, null);
  });
  by("share").addEventListener("click", () => {
    history.replaceState(null, "", `#${toHash(open.history.now)}`);
    copy(location.href, by("share-said"));
  });
  document.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    const key = event.key.toLowerCase();
    if (key === "z" && !event.shiftKey && open.history.canUndo) undo();
    else if ((key === "y" || (key === "z" && event.shiftKey)) && open.history.canRedo) redo();
    else return;
    event.preventDefault();
  });
  window.addEventListener("hashchange", () => {
    const state = fromHash(location.hash);
    if (state === null) return;
    forced = true;
    go(state, null);
    pictures.view(state);
  });
  pictures.onPointed((x) => {
    const asked = open.curve.asked(open.history.now);
    const about = open.about.parameters.find((each) => each.name === asked?.x);
    if (about) set(about.name, `${x(about)} ${about.unit}`.trim(), `point ${about.name}`);
  }, () => open.history.settle());
}

async function start() {
  chooseTheme(by("theme"));
  const presets = await get("presets");
  if (presets.faults?.length) {
    say(by("fault"), presets.faults[0].sentence);
    return;
  }
  by("version").textContent = presets.version;
  by("preset").replaceChildren(...presets.presets.map(({ name, file }) => option(name, file ? `${name} (your file)` : name)));
  open.history = new History(fromHash(location.hash) ?? newState(presets.opened));
  pictures.view(open.history.now);
  by("preset").value = open.history.now.preset;
  addSaving(() => [open.history.now.preset, open.history.now.case && `case-${open.history.now.case}`].filter(Boolean).join("-"));
  listen();
  await request(open.history.now);
}

start();

/** The page: what is set goes to the library, and what comes back is drawn. */

import { get, newest } from "./api.js";
import { askDefaults, askLight, askPath, askPictures, askText, keyOf } from "./asking.js";
import { Controls } from "./controls.js";
import { CurveChoice, FINE } from "./curve_choice.js";
import { by, debounced, option, say } from "./dom.js";
import { Texts, addSaving } from "./export.js";
import { listen } from "./listen.js";
import { Pictures } from "./pictures.js";
import { History, fromHash, newState, toHash, withEntry, withoutIdle } from "./state.js";
import { chooseTheme } from "./theme.js";
import { typeset, useUnits } from "./units.js";

/** What is open: the description of the preset, its controls, the history. */
const open = { about: null, key: null, controls: null, curve: null, history: null, answer: null };
const pictures = new Pictures(turned);
const texts = new Texts((form) => {
  const { now } = open.history;
  return open.about && askText(now, open.about, open.curve.asked(now), form);
});
const refreshTexts = debounced(() => texts.refresh(), 400);
const writeAddress = debounced(
  () => history.replaceState(null, "", `#${toHash(open.history.now)}`),
  120,
);

/** Open the preset where it is another one, and find its light. */
async function ask(state) {
  const key = keyOf(state);
  if (key !== open.key) {
    const about = await askPath(state);
    if (about.faults?.length) return about;
    adopt(about, key);
  }
  const answer = await askLight(state, open.about);
  const bare = open.answer === null && answer.faults.length > 0;
  return bare ? { ...answer, before: await askDefaults(state) } : answer;
}

/** Take up a preset: its controls take the place of those before. */
function adopt(about, key) {
  const same = open.about?.preset === about.preset;
  const known = same ? document.activeElement?.id : "";
  Object.assign(open, { about, key, answer: null });
  const actions = { set, settle: () => open.history.settle(), place };
  open.controls = new Controls(by("controls"), about, actions);
  open.curve = new CurveChoice(about, (change, step) =>
    go({ ...open.history.now, curve: { ...open.history.now.curve, ...change } }, step),
  );
  if (known) by(known)?.focus();
  if (!same) for (const id of ["light", "pictures"]) by(id).classList.add("other");
  by("preset").value = about.preset;
  say(by("description"), about.description);
}

/** Whether the next answer is written into a field that has the focus, too. */
let forced = false;

function show(state, answer) {
  const faults = answer.faults ?? [];
  const stale = faults.length > 0;
  say(by("fault"), sentences(open.controls?.complain(faults) ?? faults));
  if (answer.before) {
    take(state, answer.before);
    pictures.showMore(answer.before, open.about);
  } else if (stale && open.about !== null && open.answer === null) pictures.clear();
  document.body.classList.toggle("stale", stale && open.answer !== null);
  by("stale").hidden = !(stale && open.answer !== null);
  open.curve?.update(state);
  const found = open.about?.cases.find((each) => each.name === state.case);
  say(by("note"), found?.note ? typeset(found.note) : "");
  refreshTexts();
  if (stale) {
    refine.cancel();
    by("pictures").ariaBusy = "false";
    if (isNow(state)) open.controls?.keep(state);
    return;
  }
  take(state, answer);
  if (isNow(state)) forced = false;
  requestMore({ state, fine: false });
  refine({ state, fine: true });
}

const sentences = (faults) => faults.map((each) => each.sentence).join("\n");

/** The pictures that take longer; at rest, a curve of more points. */
async function askMore({ state, fine }) {
  const curve = open.curve.asked(state, fine ? FINE : undefined);
  return keyOf(state) === open.key ? askPictures(state, open.about, curve) : null;
}

function showMore({ state, fine }, answer) {
  if (answer === null || keyOf(state) !== open.key) return;
  if (isNow(state)) by("pictures").ariaBusy = "false";
  if (answer.faults.length > 0) {
    say(by("fault"), sentences(answer.faults));
    return;
  }
  say(by("told"), typeset((answer.notes ?? []).join(" ")));
  pictures.showMore(answer, open.about, fine);
}

const requestMore = newest(askMore, showMore);
const refine = debounced(requestMore, 250);

/** Whether nothing has been set since. */
function isNow(state) {
  return ["preset", "case", "places", "values"].every(
    (part) => state[part] === open.history.now[part],
  );
}

/** Show what an answer without faults says. */
function take(state, answer) {
  open.answer = answer;
  // An answer that has been overtaken is drawn, but leaves the sliders where they are by now.
  if (isNow(state)) open.controls.update(state, answer.values, forced);
  pictures.show(state, answer);
}

const request = newest(ask, show);

/**
 * Go to a state, a step that can be undone; changes under one `key` are one step.
 *
 * @param {boolean} all whether the field that has the focus is written, too
 */
function go(state, key, all = false) {
  if (toHash(state) === toHash(open.history.now)) return;
  forced ||= all;
  open.history.push(state, key);
  shown();
}

function shown() {
  by("undo").disabled = !open.history.canUndo;
  by("redo").disabled = !open.history.canRedo;
  writeAddress();
  texts.age();
  by("pictures").ariaBusy = "true";
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
  open.history.replace({
    ...now,
    views: { ...now.views, [name]: view && view.map((each) => Math.round(each * 100) / 100) },
  });
  writeAddress();
}

/** @param {"undo"|"redo"} way */
function step(way) {
  if (!(way === "undo" ? open.history.canUndo : open.history.canRedo)) return;
  forced = true;
  pictures.view(open.history[way]());
  shown();
}

async function start() {
  chooseTheme(by("theme"));
  const presets = await get("presets");
  if (presets.faults?.length) {
    say(by("fault"), presets.faults[0].sentence);
    return;
  }
  useUnits(presets.units);
  by("version").textContent = presets.version;
  by("preset").replaceChildren(
    ...presets.presets.map(({ name, file }) => option(name, file ? `${name} (your file)` : name)),
  );
  open.history = new History(fromHash(location.hash) ?? newState(presets.opened));
  pictures.view(open.history.now);
  by("preset").value = open.history.now.preset;
  addSaving(() =>
    [open.history.now.preset, open.history.now.case && `case-${open.history.now.case}`]
      .filter(Boolean)
      .join("-"),
  );
  listen({ open, pictures, go, step, set });
  await request(open.history.now);
}

start();

/** What the fields and keys beside the parameters do. */

import { by } from "./dom.js";
import { copy } from "./export.js";
import { fromHash, newState, toHash } from "./state.js";
import { onStepKeys } from "./step_keys.js";
import { converted, stepped } from "./units.js";

/**
 * @param {object} page its `open` path and history, its `pictures`, and its functions `go` (to a
 *   state), `step` ("undo" or "redo") and `set` (a parameter)
 */
export function listen({ open, pictures, go, step, set }) {
  const now = () => open.history.now;
  by("preset").addEventListener("change", () => go(newState(by("preset").value), null));
  by("case").addEventListener("change", () =>
    go({ ...now(), case: by("case").value || null, places: {}, values: {} }, null, true),
  );
  by("detector").addEventListener("change", () =>
    go({ ...now(), detector: by("detector").value }, null),
  );
  by("undo").addEventListener("click", () => step("undo"));
  by("redo").addEventListener("click", () => step("redo"));
  by("reset").addEventListener("click", () => {
    const known = open.about?.cases.some((each) => each.name === now().case);
    const { preset, views } = now();
    go({ ...newState(preset), case: known ? now().case : null, views }, null, true);
  });
  by("share").addEventListener("click", () => {
    history.replaceState(null, "", `#${toHash(now())}`);
    copy(location.href, by("share-said"));
  });
  onStepKeys(
    () => step("undo"),
    () => step("redo"),
  );
  window.addEventListener("hashchange", () => {
    const state = fromHash(location.hash);
    if (state === null) return;
    go(state, null, true);
    pictures.view(state);
  });
  pictures.onPointed(
    (curve, x) => {
      const asked = open.curve.asked(now());
      const about = open.about.parameters.find((each) => each.name === asked?.x);
      if (about) set(about.name, pointedText(curve, x, about), `point ${about.name}`);
    },
    () => open.history.settle(),
  );
}

/** What is pointed at on a curve, as a value of its parameter, in the steps of its slider. */
export function pointedText(curve, x, { slider, unit }) {
  const ends = [Math.min(...curve.x), Math.max(...curve.x)];
  const [low, high, at] = [...ends, Math.max(ends[0], Math.min(ends[1], x))].map((each) =>
    converted(each, curve.unit, unit),
  );
  const fine = 10 ** Math.floor(Math.log10((high - low) / 100 || 1));
  return `${stepped(at, slider[0], Math.min(slider[2], fine))} ${unit}`.trim();
}

/** What the fields and keys beside the parameters do. */

import { by } from "./dom.js";
import { copy } from "./export.js";
import { fromHash, newState, toHash } from "./state.js";
import { onStepKeys } from "./step_keys.js";

/**
 * @param {object} page its `open` path and history, its `pictures`, and its functions `go` (to a
 *   state), `step` ("undo" or "redo") and `set` (a parameter)
 */
export function listen({ open, pictures, go, step, set }) {
  const now = () => open.history.now;
  by("preset").addEventListener("change", () => go(newState(by("preset").value), null));
  by("case").addEventListener("change", () =>
    go({ ...now(), case: by("case").value || null, values: {} }, null, true),
  );
  by("detector").addEventListener("change", () =>
    go({ ...now(), detector: by("detector").value }, null),
  );
  by("undo").addEventListener("click", () => step("undo"));
  by("redo").addEventListener("click", () => step("redo"));
  by("reset").addEventListener("click", () => go({ ...now(), values: {}, places: {} }, null, true));
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
    (x) => {
      const asked = open.curve.asked(now());
      const about = open.about.parameters.find((each) => each.name === asked?.x);
      if (about) set(about.name, `${x(about)} ${about.unit}`.trim(), `point ${about.name}`);
    },
    () => open.history.settle(),
  );
}

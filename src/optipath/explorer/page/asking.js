/** What the server is asked of a state: the light first, what is slower to find after it. */

import { post } from "./api.js";
import { withoutIdle } from "./state.js";

const PICTURES = ["scene", "energy", "explanation"];

export const keyOf = (state) => JSON.stringify([state.preset, state.places]);

/** The part of a state that the server is told. */
function told(state, about) {
  const { preset, places, values, detector } = withoutIdle(state, about);
  return { preset, case: state.case, places, values, detector };
}

/** What a preset is; where elements cannot stand as a state has them, as they stand by default. */
export async function askPath({ preset, places }) {
  const about = await post("open", { preset, places });
  const misplaced = about.faults?.length > 0 && Object.keys(places).length > 0;
  return misplaced ? post("open", { preset, places: {} }) : about;
}

/** The light at the ends and on the way. */
export const askLight = (state, about) => post("trace", told(state, about));

/** The pictures besides, and a curve. */
export const askPictures = (state, about, curve) =>
  post("trace", { ...told(state, about), curve, want: PICTURES });

/** What is taken along. */
export const askText = (state, about, curve, form) =>
  post("export", { ...told(state, about), curve, form });

/** What a preset shows by itself, for a state that cannot be; null where it shows nothing. */
export async function askDefaults({ preset }) {
  const answer = await post("trace", { preset, want: PICTURES });
  return answer.faults.length > 0 ? null : answer;
}

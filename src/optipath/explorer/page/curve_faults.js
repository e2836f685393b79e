/** What a curve cannot show. */

import { short } from "./units.js";
import { least, most } from "./words.js";

/** A sentence where a curve goes from a place to itself. @param {object|null} curve */
export function flat(curve) {
  if (!curve || curve.x[0] !== curve.x[curve.x.length - 1]) return [];
  return [`The curve goes from ${short(curve.x[0])} to itself; give two ends that differ.`];
}

const FEW = 12;

/** Whether a line turns at nearly every other point somewhere: there may be more between them. */
export const isTooFast = (curve) =>
  Boolean(curve) && curve.lines.some(({ values }) => turnsEverywhere(values));

/** @param {object|null} curve @returns {string} */
export const tooFast = (curve) =>
  isTooFast(curve) ? "It varies faster than is drawn; take ends that are nearer to each other." : "";

function turnsEverywhere(values) {
  const [low, high] = [least(values), most(values)];
  const rounding = 1e-4 * (high - low);
  const steps = values.slice(1).map((each, i) => each - values[i]);
  const turns = steps
    .slice(1)
    .map((each, i) => each * steps[i] < 0 && Math.min(Math.abs(each), Math.abs(steps[i])) > rounding);
  let count = 0;
  return turns.some((each, i) => {
    count += Number(each) - Number(turns[i - FEW] ?? false);
    return count > FEW / 2;
  });
}

/** What pictures show, as sentences. */

import { short, typeset } from "./units.js";

/** @param {string} name of a detector @param {object} light @returns {string} */
export function lightInWords(name, light) {
  const stokes = light.texts.map((each, i) => `S${i} ${each}`).join(", ");
  return typeset(`Light at ${name}: ${stokes}; ${stateInWords(light)}.`);
}

/** @param {object} light @returns {string} */
export function stateInWords(light) {
  const { dop, aop, handedness } = light.ellipse;
  if (light.stokes[0] === 0) return "dark";
  if (light.ellipse.points === null) return "unpolarised";
  const share = dop > 0.9995 ? "fully polarised" : `polarised by ${short(100 * dop, 3)} %`;
  const axis = aop === null ? "" : `, axis at ${short(aop, 4)} deg from x`;
  return `${share}, ${handedness}${aop === null ? ", circular" : ""}${axis}`;
}

/** @param {object[]} along lights on the way @param {string} name @param {object} light */
export function sphereInWords(along, name, light) {
  const place = (point) => point.map((each) => short(each, 3)).join(", ");
  const here = light.poincare === null ? "no polarised light" : `at (${place(light.poincare)})`;
  const way = along
    .filter((each) => each.poincare !== null)
    .map((each) => `${each.link} (${place(each.poincare)})`)
    .join("; ");
  return typeset(`Poincaré sphere. Light at ${name}: ${here}.${way ? ` On the way: ${way}.` : ""}`);
}

/** @param {object} curve @returns {string} */
export function curveInWords(curve) {
  const parts = curve.lines.map(({ label, name, unit, values }) => {
    const there = values.filter((each) => each !== null);
    if (there.length === 0) return `${name} has no value`;
    const [low, high] = [least(there), most(there)].map((each) => short(each, 4));
    return `${name}${label && label !== name ? ` (${label})` : ""} from ${low} to ${high}${unit ? ` ${unit}` : ""}`;
  });
  const ends = [curve.x[0], curve.x[curve.x.length - 1]].map((each) => short(each, 4));
  const at = curve.at === null ? "" : ` Now at ${short(curve.at, 6)}.`;
  return typeset(`Against ${curve.x_label} from ${ends[0]} to ${ends[1]}: ${parts.join("; ")}.${at}`);
}

/** What a material stands for, or where a value comes from; "" for a plain value. */
export function materialInWords({ material, n, k, by }) {
  if (by !== undefined) return `that of the material of ${by}`;
  if (material === undefined) return "";
  const numbers = [["n", n], ["k", k]].filter(([, each]) => typeof each === "number");
  return [material, ...numbers.map(([name, each]) => `${name} ${short(each, 6)}`)].join(", ");
}

export const least = (numbers) => numbers.reduce((a, b) => Math.min(a, b), Infinity);
export const most = (numbers) => numbers.reduce((a, b) => Math.max(a, b), -Infinity);

/** @param {object} scene @returns {string} */
export function sceneInWords(scene) {
  const names = scene.nodes.map(({ name, kind }) => (kind && kind !== name ? `${name} (${kind})` : name));
  const angles = scene.angles.map((each) => each.text);
  const said = angles.length > 0 ? ` Angles: ${angles.join(", ")}.` : "";
  return typeset(`Geometry in space. ${names.join(", ")}; ${scene.rays.length} rays.${said} ${scene.notes.join(". ")}`);
}

/** @param {object} energy @returns {string} */
export function energyInWords(energy) {
  if (energy.text) return `Power along the path. ${typeset(energy.text)}`;
  const parts = energy.links.map(({ name, text }) => `${name}: ${text}`);
  return typeset(`Power along the path. ${parts.join("; ")}.`);
}

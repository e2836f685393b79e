/** Numbers written in one unit or another; what they mean is the library's. */

/** The units of the library by name, each with its dimension and its size in base units. */
let units = {};

/** Take the units from the library's first answer, before anything is converted. */
export function useUnits(served) {
  units = served;
}

/** How large a unit such as "deg", "1/cm" or "deg/(T cm)" is in base units; NaN where unknown. */
export function sizeOf(unit) {
  const [above, below = ""] = unit.split("/");
  const product = (words) =>
    words
      .replace(/[()]/g, "")
      .split(" ")
      .filter((word) => word !== "" && word !== "1")
      .reduce((size, word) => size * (units[word]?.size ?? NaN), 1);
  return product(above) / product(below);
}

/** @param {number} number @param {string} from @param {string} to */
export function converted(number, from, to) {
  return from === to ? number : (number * sizeOf(from)) / sizeOf(to);
}

/** A number as short as ten digits allow. @param {number} number */
export function short(number, digits = 10) {
  return String(Number(number.toPrecision(digits)));
}

/** A number as the steps of a slider allow, without the dust of sums. */
export function stepped(number, low, step) {
  const places = Math.max(0, 2 - Math.floor(Math.log10(step)));
  return String(
    Number((low + Math.round((number - low) / step) * step).toFixed(Math.min(places, 20))),
  );
}

/** What stands in a field, cut into the number and the unit, where it is a number at all. */
export function taken(text) {
  const found = /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*(.*?)\s*$/i.exec(text);
  return found === null ? null : { number: Number(found[1]), written: found[1], unit: found[2] };
}

const RAISED = "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079";

/** Two digits of a number, times a power of ten where it is very small or large. */
export function powered(number) {
  if (Math.abs(number) >= 1e-3 && Math.abs(number) < 1e4) return short(number, 2);
  const [digits, power] = number.toExponential(1).split("e");
  const raised = [...power.replace("+", "")].map((each) => RAISED[each] ?? "\u207b");
  return `${digits}\u00b710${raised.join("")}`;
}

/** For the eye: a true minus sign and a degree sign. */
export function typeset(text) {
  return text
    .replace(/(^|[\s(=])-(?=\d)|^-(?=[a-z])/gi, "$1\u2212")
    .replace(/(\de)-(?=\d)/g, "$1\u2212")
    .replace(/(\d) deg\b/g, "$1\u00b0");
}

/** What stands in a field, as the library reads it: what is written for the eye is undone. */
export function plainText(text) {
  return text
    .trim()
    .replace(/\u2212/g, "-")
    .replace(/\s*\u00b0/g, " deg");
}

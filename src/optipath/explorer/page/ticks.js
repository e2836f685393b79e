/** Round numbers along an axis. */

/** @param {number} count about how many @returns {number[]} */
export function ticks(low, high, count = 5, bases = [1, 2, 5, 10]) {
  if (!(high > low)) return [low];
  const rough = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step =
    bases.map((base) => base * power).find((each) => each >= rough * 0.999) ?? 10 * power;
  const places = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const found = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i += 1) {
    found.push(Number((i * step).toFixed(Math.min(20, places + 1))));
  }
  return found;
}

/** Ticks of degrees fall on parts of a right angle. */
export function degreeTicks(low, high, count = 5) {
  const rough = (high - low) / count;
  const step = [1, 2, 5, 10, 15, 30, 45, 90, 180].find((each) => each >= rough * 0.999);
  if (rough < 0.5 || step === undefined) return ticks(low, high, count);
  const found = [];
  for (let at = Math.ceil(low / step) * step; at <= high + 1e-9; at += step) found.push(at);
  return found;
}

/** @returns {string} a number of an axis, with a true minus sign */
export function ofAxis(number) {
  const small = number !== 0 && (Math.abs(number) < 1e-4 || Math.abs(number) >= 1e6);
  return (small ? number.toExponential(1) : String(Number(number.toPrecision(6)))).replace(
    "-",
    "\u2212",
  );
}

/** The range of an axis that shows all numbers, never of no length. @param {number[]} numbers */
export function rangeOf(numbers) {
  let [low, high] = [Infinity, -Infinity];
  for (const each of numbers) {
    if (each === null) continue;
    low = Math.min(low, each);
    high = Math.max(high, each);
  }
  if (low > high) return [0, 1];
  const scale = Math.max(Math.abs(low), Math.abs(high));
  if (high - low <= 1e-9 * scale || scale === 0) {
    if (scale === 0) return [0, 1];
    return low > 0 ? [0, 1.25 * high] : [1.25 * low, 0];
  }
  const room = 0.06 * (high - low);
  return [low - room, high + room];
}

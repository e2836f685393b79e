/** Places for names, so that none is over another. */

const SIZE = 13;
const BOLD = 1.18;
/** How much worse it is to stand over another name than over a line. */
const WORSE = 8;

/** @returns {number} about how wide a text of 13 units is */
export function wide(words, size = SIZE) {
  let total = 0;
  for (const letter of words)
    total += /[ilI.,:;'|()[\]j ]/.test(letter) ? 0.32 : /[mwMW]/.test(letter) ? 0.86 : 0.6;
  return total * size * BOLD;
}

/** The common area of two boxes [left, top, right, bottom]. */
export function overlap(one, other) {
  const x = Math.min(one[2], other[2]) - Math.max(one[0], other[0]);
  const y = Math.min(one[3], other[3]) - Math.max(one[1], other[1]);
  return x > 0 && y > 0 ? x * y : 0;
}

const DIRECTIONS = [
  [1, -0.6],
  [1, 0.6],
  [-1, -0.6],
  [-1, 0.6],
  [0, -1],
  [0, 1],
  [1, 0],
  [-1, 0],
];

/**
 * Where labels stand: each near its point, away from the labels before it and from obstacles.
 *
 * @param {{at: number[], words: string}[]} labels
 * @param {number[]} room [width, height]
 * @param {number[][]} obstacles boxes [left, top, right, bottom]
 * @returns {{x: number, y: number, box: number[], far: boolean}[]} the middle of the base line
 */
export function placed(labels, room, obstacles = []) {
  const names = [];
  return labels.map(({ at, words, size = SIZE }) => {
    const width = wide(words, size);
    let best = null;
    for (const [ring, distance] of [7, 16, 28, 42, 60, 80].entries()) {
      for (const [i, [dx, dy]] of DIRECTIONS.entries()) {
        const middle = [
          at[0] + dx * (distance + (dx === 0 ? 0 : width / 2)),
          at[1] + dy * (distance + 3),
        ];
        const box = [
          middle[0] - width / 2,
          middle[1] - size * 0.55,
          middle[0] + width / 2,
          middle[1] + size * 0.55,
        ];
        const cost =
          ring * 30 + i + 4 * outside(box, room) + over(box, obstacles) + WORSE * over(box, names);
        if (best === null || cost < best.cost) best = { cost, box, middle, far: ring > 1 };
      }
      if (best.cost < ring * 30 + DIRECTIONS.length) break;
    }
    names.push(best.box);
    return { x: best.middle[0], y: best.middle[1] + size * 0.34, box: best.box, far: best.far };
  });
}

const over = (box, boxes) => boxes.reduce((sum, each) => sum + overlap(box, each), 0);

function outside([left, top, right, bottom], [width, height]) {
  const beyond = Math.max(0, 2 - left) + Math.max(0, right - width + 2);
  return 20 * (beyond + Math.max(0, 2 - top) + Math.max(0, bottom - height + 2));
}

/** Boxes along a line, as obstacles. */
export function along(from, to, half = 2) {
  const steps = Math.max(1, Math.ceil(Math.hypot(to[0] - from[0], to[1] - from[1]) / 8));
  return Array.from({ length: steps + 1 }, (_, i) => {
    const [x, y] = [0, 1].map((k) => from[k] + ((to[k] - from[k]) * i) / steps);
    return [x - half, y - half, x + half, y + half];
  });
}

/** The box around points, not less than 24 wide and high. */
export function around(points) {
  const side = (k) => points.map((each) => each[k]);
  const [left, top] = [0, 1].map((k) => Math.min(...side(k)));
  const [right, bottom] = [0, 1].map((k) => Math.max(...side(k)));
  const room = [24 - (right - left), 24 - (bottom - top)].map((each) => Math.max(0, each) / 2);
  return [left - room[0], top - room[1], right + room[0], bottom + room[1]];
}

/** Heights moved apart by at least `gap`, in their order, within [low, high]. */
export function spread(heights, gap, low, high) {
  const order = heights.map((_, i) => i).sort((a, b) => heights[a] - heights[b]);
  const found = [];
  let last = low - gap;
  for (const i of order) {
    last = Math.max(heights[i], last + gap);
    found[i] = last;
  }
  let next = high + gap;
  for (const i of order.reverse()) {
    next = Math.min(found[i], next - gap);
    found[i] = next;
  }
  return found;
}

/** Space seen from afar: lines that are parallel stay parallel. Turned by dragging and by keys. */

const DEGREE = Math.PI / 180;

/**
 * @param {number[]} view azimuth and elevation of the eye, in degrees; z is up
 * @returns {(point: number[]) => number[]} x to the right, y down, and nearness to the eye
 */
export function projected(view) {
  const [a, e] = [view[0] * DEGREE, view[1] * DEGREE];
  const right = [-Math.sin(a), Math.cos(a), 0];
  const up = [-Math.sin(e) * Math.cos(a), -Math.sin(e) * Math.sin(a), Math.cos(e)];
  const near = [Math.cos(e) * Math.cos(a), Math.cos(e) * Math.sin(a), Math.sin(e)];
  return (point) => [dot(point, right), -dot(point, up), dot(point, near)];
}

export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const plus = (a, b, times = 1) => a.map((each, i) => each + times * b[i]);
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

/** @param {number[]} view @param {number} across @param {number} over both in degrees */
export function turned(view, across, over) {
  const azimuth = ((((view[0] + across + 180) % 360) + 360) % 360) - 180;
  return [azimuth, Math.max(-90, Math.min(90, view[1] + over)), ...view.slice(2)];
}

const KEYS = { ArrowLeft: [5, 0], ArrowRight: [-5, 0], ArrowUp: [0, 5], ArrowDown: [0, -5] };

/**
 * Let a frame be turned: by dragging, by arrow keys, Home to turn back, + and - to come nearer.
 *
 * @param {HTMLElement} frame
 * @param {() => number[]} view
 * @param {(view: number[]|null, ended: boolean) => void} change null: as at first
 */
export function turnable(frame, view, change) {
  let last = null;
  frame.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    last = [event.clientX, event.clientY];
    frame.setPointerCapture(event.pointerId);
  });
  frame.addEventListener("pointermove", (event) => {
    if (last === null) return;
    const scale = 220 / Math.max(200, Math.min(frame.clientWidth, frame.clientHeight));
    const moved = [event.clientX - last[0], event.clientY - last[1]];
    last = [event.clientX, event.clientY];
    change(turned(view(), -moved[0] * scale, moved[1] * scale), false);
  });
  for (const name of ["pointerup", "pointercancel"]) {
    frame.addEventListener(name, () => {
      if (last !== null) change(view(), true);
      last = null;
    });
  }
  frame.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key in KEYS) change(turned(view(), ...KEYS[event.key]), true);
    else if (event.key === "Home") change(null, true);
    else if (view().length > 2 && "+=-".includes(event.key))
      change(nearer(view(), event.key === "-" ? 0.8 : 1.25), true);
    else return;
    event.preventDefault();
  });
}

export function nearer(view, times) {
  return [view[0], view[1], Math.max(0.4, Math.min(6, view[2] * times))];
}

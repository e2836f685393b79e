/** Which curve is drawn: against what, from where to where, and of what. */

import { by, chip, element, option } from "./dom.js";
import { takesPart } from "./state.js";
import { plainText } from "./units.js";

/** How many points a curve has while something is moved, and at rest. */
const COARSE = 181;
export const FINE = 2001;

const field = (words, made) => element("label", { className: "named" }, `${words} `, made);

export class CurveChoice {
  /**
   * @param {object} about of the preset
   * @param {(change: object, key: string|null) => void} change
   */
  constructor(about, change) {
    this.about = about;
    this.able = about.parameters.filter((each) => each.slider && !each.bound && !each.array);
    this.x = element("select", {}, ...this.able.map((each) => option(each.name)));
    this.from = element("input", {
      type: "text",
      autocomplete: "off",
      "aria-describedby": "curve-fault",
    });
    this.to = element("input", {
      type: "text",
      autocomplete: "off",
      "aria-describedby": "curve-fault",
    });
    this.x.addEventListener("change", () => change({ x: this.x.value, from: "", to: "" }, null));
    this.from.addEventListener("change", () => change({ from: plainText(this.from.value) }, null));
    this.to.addEventListener("change", () => change({ to: plainText(this.to.value) }, null));
    by("curve-range").replaceChildren(
      field("against", this.x),
      field("from", this.from),
      field("to", this.to),
    );
    this.chips = about.quantities.map((each) =>
      chip(each.name, false, () => change({ y: this.toggled(each.name) }, null)),
    );
    about.quantities.forEach((each, i) => {
      if (each.label) this.chips[i].title = each.label;
    });
    by("curve-outputs").replaceChildren(...this.chips);
  }

  toggled(name) {
    const rest = this.now.filter((each) => each !== name);
    const chosen = rest.length < this.now.length ? rest : [...this.now, name];
    return this.about.quantities.map((each) => each.name).filter((each) => chosen.includes(each));
  }

  /** The curve to ask for, with what is left open filled in; null where there is none. */
  asked(state, count = COARSE) {
    const { x, from, to, y } = state.curve;
    const having = this.able.filter((each) => takesPart(each, state, this.about));
    const first = having.find((each) => each.name === "wavelength") ?? having[0];
    const name = x ?? first?.name;
    const parameter = this.able.find((each) => each.name === name);
    if (name === undefined || y.length === 0) return null;
    const [low, high] = parameter?.slider ?? [0, 1];
    return { x: name, from: from || String(low), to: to || String(high), count, y };
  }

  /** @param {object} state */
  update(state) {
    this.now = state.curve.y;
    const asked = this.asked({ ...state, curve: { ...state.curve, y: ["S0"] } });
    if (asked === null) return;
    [...this.x.options].forEach(
      (each, i) => (each.hidden = !takesPart(this.able[i], state, this.about)),
    );
    this.x.value = asked.x;
    for (const [field, text] of [
      [this.from, asked.from],
      [this.to, asked.to],
    ]) {
      if (document.activeElement !== field) field.value = text;
    }
    this.chips.forEach((each) =>
      each.setAttribute("aria-pressed", String(this.now.includes(each.textContent))),
    );
  }
}

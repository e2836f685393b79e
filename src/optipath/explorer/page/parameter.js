/** One parameter: a slider, a field, a unit, words, and the sentence of what is wrong. */

import { chip, debounced, element, option, say } from "./dom.js";
import { converted, plainText, short, stepped, taken } from "./units.js";
import { materialInWords } from "./words.js";

/** The unit of more letters has more room. */
const LONG = 4;

/**
 * @typedef {{set: (name: string, text: string|null, key: string|null) => void,
 *   settle: () => void}} Actions
 */
export class ParameterRow {
  /** @param {object} about of the parameter, from the server @param {Actions} actions */
  constructor(about, actions) {
    this.about = about;
    this.actions = actions;
    this.unit = about.unit;
    this.value = null;
    const id = `parameter-${about.name}`;
    this.field = element("input", {
      type: "text",
      id,
      autocomplete: "off",
      spellcheck: false,
      disabled: about.bound,
      "aria-describedby": `${id}-help ${id}-fault`,
    });
    this.slider = this.makeSlider();
    this.units = this.makeUnits();
    this.words = about.words.map((word) => chip(word, false, () => this.choose(word)));
    this.fault = element("p", { className: "fault", id: `${id}-fault`, hidden: true });
    this.back = element(
      "button",
      {
        type: "button",
        className: "back",
        hidden: true,
        title: `Back to the value of ${about.name} in the case, or its default`,
        "aria-label": `Reset ${about.name}`,
      },
      "\u21ba",
    );
    this.back.addEventListener("click", () => actions.set(about.name, null, null));
    this.root = this.lay(id);
    this.listen();
  }

  lay(id) {
    const { name, help } = this.about;
    const label = element("label", { for: id }, name);
    const fields = element("div", { className: "fields" }, this.field, this.units);
    const parts = [element("div", { className: "head" }, label, this.back, fields)];
    if (this.slider !== null) parts.push(this.slider);
    if (this.words.length > 0) {
      parts.push(
        element(
          "div",
          { className: "words", role: "group", "aria-label": `Words for ${name}` },
          ...this.words,
        ),
      );
    }
    const said = this.about.materials
      ? `${help}${help ? "; " : ""}a number or the name of a material`
      : help;
    this.material = element("p", { className: "help", hidden: true });
    parts.push(
      element("p", { className: "help", id: `${id}-help` }, said),
      this.material,
      this.fault,
    );
    return element("div", { className: "parameter", role: "group", "aria-label": name }, ...parts);
  }

  makeSlider() {
    const { slider, bound, array, name } = this.about;
    if (bound || array || !slider) return null;
    const [min, max, step] = slider;
    return element("input", { type: "range", min, max, step, "aria-label": `${name}, slider` });
  }

  makeUnits() {
    const { units, unit, name } = this.about;
    if (units.length < 2) return element("span", { className: "unit" }, unit);
    const made = element(
      "select",
      { className: "unit", "aria-label": `Unit of ${name}` },
      ...units.map((each) => option(each)),
    );
    made.value = unit;
    made.classList.toggle("long", unit.length > LONG);
    return made;
  }

  listen() {
    const { name } = this.about;
    const typed = debounced(() => this.type(), 300);
    this.field.addEventListener("input", typed);
    this.field.addEventListener("change", () => {
      typed.cancel();
      this.type();
      this.actions.settle();
    });
    this.units.addEventListener("change", () => {
      this.show(this.units.value);
      this.write();
    });
    this.slider?.addEventListener("input", () => {
      const [low, , step] = this.about.slider;
      const number = stepped(Number(this.slider.value), low, step);
      const text = `${number} ${this.about.unit}`.trim();
      this.value = { text, number: Number(number), unit: this.about.unit, word: null };
      this.write();
      this.actions.set(name, text, `slide ${name}`);
    });
    this.slider?.addEventListener("change", () => this.actions.settle());
  }

  choose(word) {
    this.actions.set(this.about.name, word, null);
  }

  /** Take what stands in the field; a bare number is in the unit beside it. */
  type() {
    const text = plainText(this.field.value);
    const { name, units } = this.about;
    const read = taken(text);
    if (read !== null && units.includes(read.unit) && this.unit !== read.unit) this.show(read.unit);
    const bare = read !== null && read.unit === "" && this.unit !== "";
    this.actions.set(
      name,
      text === "" ? null : bare ? `${text} ${this.unit}` : text,
      `type ${name}`,
    );
  }

  show(unit) {
    this.unit = unit;
    this.units.value = unit;
    this.units.classList.toggle("long", unit.length > LONG);
  }

  /** @param {object} value from the server @param {boolean} changed from the case or default */
  update(value, changed, forced) {
    this.value = value;
    this.back.hidden = !changed || this.about.bound;
    if (forced || document.activeElement !== this.field) this.write();
    this.slide();
    say(this.material, materialInWords(value));
    for (const each of this.words)
      each.setAttribute("aria-pressed", String(each.textContent === value.word));
  }

  /** A value that the server has refused, or not yet seen, as it was given. */
  keep(text) {
    if (document.activeElement !== this.field) this.field.value = this.written(text);
  }

  write() {
    if (this.value === null) return;
    const { text, word } = this.value;
    this.field.value = word ?? this.written(text);
  }

  /** A text in the unit beside the field, where it is a number in a unit that is known. */
  written(text) {
    const read = taken(text);
    if (read === null) return text;
    if (read.unit === this.unit) return read.written.length > 12 ? short(read.number) : read.written;
    const number = converted(read.number, read.unit || this.about.unit, this.unit);
    return Number.isNaN(number) ? text : short(number);
  }

  slide() {
    if (this.slider === null) return;
    const { number, text, word } = this.value;
    this.slider.classList.toggle("idle", number === null || word === "none");
    this.slider.setAttribute("aria-valuetext", word ?? text);
    if (number === null) return;
    const [low, high] = this.about.slider;
    this.slider.min = Math.min(low, number);
    this.slider.max = Math.max(high, number);
    if (Number(this.slider.value) !== number) this.slider.value = String(number);
  }

  /** @param {string} sentence what is wrong, or "" */
  complain(sentence) {
    say(this.fault, sentence);
    if (sentence === "") this.field.removeAttribute("aria-invalid");
    else this.field.setAttribute("aria-invalid", "true");
  }
}

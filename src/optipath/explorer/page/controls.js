/** What can be set: where elements stand, and the parameters. */

import { by, element, option, say } from "./dom.js";
import { ParameterRow } from "./parameter.js";
import { takesPart } from "./state.js";

export class Controls {
  /** @param {HTMLElement} root @param {object} about of the preset @param {object} actions */
  constructor(root, about, actions) {
    this.about = about;
    this.rows = new Map(
      about.parameters.map((each) => [each.name, new ParameterRow(each, actions)]),
    );
    this.places = new Map(about.choices.map((each) => [each.name, placeOf(each, actions)]));
    root.replaceChildren(
      element("h2", {}, "Parameters"),
      ...[...this.places.values()].map((each) => each.root),
      ...[...this.rows.values()].map((each) => each.root),
    );
    fillCases(about);
  }

  /** Show the values of an answer. */
  update(state, values, forced) {
    for (const [name, row] of this.rows) {
      if (values[name]) row.update(values[name], name in state.values, forced);
    }
    this.choose(state);
  }

  /** What is shown of a state that cannot be: values as they were given. */
  keep(state) {
    this.choose(state);
    for (const [name, text] of Object.entries(state.values)) this.rows.get(name)?.keep(text);
  }

  /** What holds without an answer. */
  choose(state) {
    for (const [name, { select, preset }] of this.places)
      select.value = state.places[name] ?? preset;
    by("case").value = state.case ?? "";
    for (const row of this.rows.values())
      row.root.hidden = !takesPart(row.about, state, this.about);
  }

  /** Put sentences at their fields; returns those that belong to none. */
  complain(faults) {
    const of = (name) => faults.filter((each) => each.field === name).map((each) => each.sentence);
    for (const [name, row] of this.rows) row.complain(of(name).join("\n"));
    for (const [name, { fault, select }] of this.places) {
      const sentence = of(name).join("\n");
      say(fault, sentence);
      select.setAttribute("aria-invalid", String(sentence !== ""));
    }
    return faults.filter((each) => !this.rows.has(each.field) && !this.places.has(each.field));
  }
}

function placeOf(choice, actions) {
  const id = `place-${choice.name}`;
  const select = element(
    "select",
    { id, "aria-describedby": `${id}-help ${id}-fault` },
    ...choice.words.map((each) => option(each)),
  );
  select.addEventListener("change", () => actions.place(choice.name, select.value));
  const fault = element("p", { className: "fault", id: `${id}-fault`, hidden: true });
  const root = element(
    "div",
    { className: "parameter" },
    element(
      "div",
      { className: "head" },
      element("label", { for: id }, choice.name),
      element("div", { className: "fields" }, select),
    ),
    element("p", { className: "help", id: `${id}-help` }, choice.help),
    fault,
  );
  return { root, select, fault, preset: choice.default };
}

function fillCases(about) {
  by("case").replaceChildren(
    option("", "none: defaults"),
    ...about.cases.map((each) => option(each.name)),
  );
  by("case").disabled = about.cases.length === 0;
}

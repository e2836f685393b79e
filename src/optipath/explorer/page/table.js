/** Numbers, as the program prints them. */

import { element } from "./dom.js";
import { powered, short, typeset } from "./units.js";

const cell = (words, properties = {}) => element("td", properties, typeset(words));
const row = (name, ...cells) => element("tr", {}, element("th", { scope: "row" }, name), ...cells);
const heading = (...names) => element("thead", {}, element("tr", {}, ...names.map((name) => element("th", { scope: "col" }, name))));

/** Fill the table of the Stokes vector, with published values where there are. */
export function fillStokes(table, name, light) {
  const { published } = light;
  const caption = element("caption", { className: "unseen" }, `Stokes vector of the light at ${name}`);
  const rows = light.texts.map((text, i) => {
    const cells = [cell(text, { className: "value" })];
    if (published) cells.push(cell(light.published_texts[i]), cell(difference(light.stokes[i], published[i])));
    return row(`S${i}`, ...cells);
  });
  const head = published ? heading("", "computed", "published", "difference") : heading("", "computed");
  table.replaceChildren(caption, head, element("tbody", {}, ...rows));
}

function difference(computed, published) {
  if (computed === null || published === null) return "";
  const apart = computed - published;
  return apart === 0 ? "0" : powered(apart);
}

/** Fill the table of what else there is to say of the light, next to what the Stokes vector says. */
export function fillQuantities(table, name, light) {
  const caption = element("caption", { className: "unseen" }, `Quantities of the light at ${name}`);
  const rows = light.quantities
    .filter((each) => !/^S[0-3]$/.test(each.name))
    .map((each) => {
      const unit = each.unit && !each.text.endsWith(each.unit) && each.number !== null ? ` ${each.unit}` : "";
      const said = each.label && each.label !== each.name ? [element("small", {}, each.label)] : [];
      return element("tr", {}, element("th", { scope: "row" }, each.name, ...said), cell(each.text + unit, { className: "value" }));
    });
  table.replaceChildren(caption, element("tbody", {}, ...rows));
}

/** Fill the table of the light on each link. */
export function fillAlong(table, along) {
  const rows = along.map((each) => {
    const dop = each.dop === null ? "\u2013" : short(each.dop, 4);
    return row(each.link, ...each.texts.map((text) => cell(text, { className: "value" })), cell(dop, { className: "value" }));
  });
  table.replaceChildren(heading("link", "S0", "S1", "S2", "S3", "DoP"), element("tbody", {}, ...rows));
}

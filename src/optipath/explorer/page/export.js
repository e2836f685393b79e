/** Pictures and texts to take along. */

import { by, chip, element } from "./dom.js";

const LOOKS = [
  "fill",
  "fill-opacity",
  "stroke",
  "stroke-width",
  "stroke-opacity",
  "stroke-dasharray",
  "stroke-linecap",
  "stroke-linejoin",
  "opacity",
  "font-family",
  "font-size",
  "font-style",
  "font-weight",
  "paint-order",
];
const SHARP = 3;

/** A picture as a file of its own: its looks are written into it, texts stay texts. */
export function svgText(svg) {
  const copy = svg.cloneNode(true);
  const originals = [svg, ...svg.querySelectorAll("*")];
  [copy, ...copy.querySelectorAll("*")].forEach((each, i) => {
    const style = getComputedStyle(originals[i]);
    const looks =
      each.tagName === "text" || each === copy
        ? LOOKS
        : LOOKS.filter((look) => !look.startsWith("font"));
    for (const look of each.tagName === "g" ? [] : looks)
      each.setAttribute(look, style.getPropertyValue(look));
    each.removeAttribute("class");
  });
  const [, , width, height] = svg.getAttribute("viewBox").split(" ");
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.setAttribute("width", width);
  copy.setAttribute("height", height);
  const ground = document.createElementNS("http://www.w3.org/2000/svg", "rect");
  for (const [key, value] of Object.entries({
    width,
    height,
    fill: getComputedStyle(svg.closest(".card")).backgroundColor,
  }))
    ground.setAttribute(key, value);
  const title = document.createElementNS("http://www.w3.org/2000/svg", "title");
  title.textContent = svg.getAttribute("aria-label");
  copy.prepend(title, ground);
  return new XMLSerializer().serializeToString(copy);
}

/** @param {SVGElement} svg @returns {Promise<Blob>} */
export async function pngBlob(svg) {
  const [, , width, height] = svg.getAttribute("viewBox").split(" ").map(Number);
  const address = URL.createObjectURL(new Blob([svgText(svg)], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = element("canvas", { width: SHARP * width, height: SHARP * height });
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    return await new Promise((done) => canvas.toBlob(done, "image/png"));
  } finally {
    URL.revokeObjectURL(address);
  }
}

/** @param {string} name of the file @param {Blob} blob */
export function save(name, blob) {
  const address = URL.createObjectURL(blob);
  const link = element("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

/** Buttons at each picture that save it. @param {() => string} stem of the file's name */
export function addSaving(stem) {
  for (const figure of document.querySelectorAll("[data-picture]")) {
    const kind = figure.dataset.picture;
    const title = figure.querySelector("h3").textContent;
    const button = (form, make) => {
      const made = element(
        "button",
        { type: "button", className: "quiet", "aria-label": `Save ${title} as ${form}` },
        form,
      );
      made.addEventListener("click", async () =>
        save(`${stem()}-${kind}.${form.toLowerCase()}`, await make(figure.querySelector("svg"))),
      );
      return made;
    };
    figure.querySelector("figcaption").append(
      element(
        "span",
        { className: "tools" },
        button("SVG", (svg) => new Blob([svgText(svg)], { type: "image/svg+xml" })),
        button("PNG", pngBlob),
      ),
    );
  }
}

const FORMS = { python: "Python", csv: "CSV", toml: "TOML" };

/** The texts: shown, copied, downloaded. */
export class Texts {
  /** @param {(form: string) => Promise<object>|null} ask null where nothing is open */
  constructor(ask) {
    this.ask = ask;
    this.form = "python";
    this.answer = null;
    this.asked = 0;
    this.chips = Object.entries(FORMS).map(([form, words]) =>
      chip(words, form === this.form, () => this.choose(form)),
    );
    by("export-forms").replaceChildren(...this.chips);
    by("export-copy").addEventListener("click", async () => {
      const answer = await this.newest();
      if (answer) copy(answer.text, by("export-said"));
    });
    by("export-save").addEventListener("click", async () => {
      const answer = await this.newest();
      if (answer) save(answer.name, new Blob([answer.text], { type: "text/plain" }));
    });
  }

  choose(form) {
    this.form = form;
    Object.keys(FORMS).forEach((each, i) =>
      this.chips[i].setAttribute("aria-pressed", String(each === form)),
    );
    return this.refresh();
  }

  /** What is shown is that of a state before. */
  age() {
    this.asked += 1;
    this.old = true;
    by("export-text").classList.add("old");
  }

  async newest() {
    if (this.old) await this.refresh();
    return this.old ? null : this.answer;
  }

  async refresh() {
    this.asked += 1;
    const { asked } = this;
    const answer = await this.ask(this.form);
    if (answer === null || asked !== this.asked) return;
    const faults = answer.faults ?? [];
    this.answer = faults.length > 0 ? null : answer;
    this.old = false;
    by("export-text").classList.remove("old");
    by("export-text").textContent =
      faults.length > 0 ? faults.map((each) => each.sentence).join("\n") : answer.text;
    for (const id of ["export-copy", "export-save"]) by(id).disabled = this.answer === null;
  }
}

/** @param {string} text @param {HTMLElement} said where it is told that it is done */
export async function copy(text, said) {
  try {
    await navigator.clipboard.writeText(text);
    said.textContent = "copied";
  } catch {
    said.textContent = "the browser does not let the page copy; select the text instead";
  }
  setTimeout(() => (said.textContent = ""), 4000);
}

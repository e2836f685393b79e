/** All that is shown of an answer. */

import { drawCurve } from "./curve.js";
import { flat, isTooFast, tooFast } from "./curve_faults.js";
import { by, chip, debounced, option, say } from "./dom.js";
import { drawEllipse } from "./ellipse.js";
import { drawEnergy } from "./energy.js";
import { turnable } from "./projection.js";
import { SCENE_VIEW, drawScene } from "./scene.js";
import { SPHERE_VIEW, drawSphere } from "./sphere.js";
import { fillAlong, fillQuantities, fillStokes } from "./table.js";
import { typeset } from "./units.js";
import { lightInWords, stateInWords } from "./words.js";

const PARTS = ["planes", "frames", "ellipses", "angles", "names"];
const USUAL = { sphere: SPHERE_VIEW, scene: SCENE_VIEW };

const svgOf = (kind) => document.querySelector(`[data-picture="${kind}"] svg`);
const canvasOf = (kind) => document.querySelector(`[data-picture="${kind}"] .canvas`);

export class Pictures {
  /** @param {(name: string, view: number[]|null) => void} keep a turned view */
  constructor(keep) {
    this.answer = null;
    this.more = null;
    this.views = { ...USUAL };
    this.parts = new Set(["planes", "ellipses", "angles", "names"]);
    this.across = null;
    this.tell = debounced((words) => (by("said").textContent = words), 700);
    for (const name of Object.keys(USUAL)) {
      const change = (view, ended) => {
        this.views[name] = view ?? USUAL[name];
        if (ended) keep(name, view);
        this.drawTurnable(name);
      };
      turnable(canvasOf(name), () => this.views[name], change);
    }
    this.addParts();
    new ResizeObserver(() => this.draw()).observe(by("pictures"));
  }

  addParts() {
    const chips = PARTS.map((part) =>
      chip(part, this.parts.has(part), (event) => {
        if (!this.parts.delete(part)) this.parts.add(part);
        event.currentTarget.setAttribute("aria-pressed", String(this.parts.has(part)));
        this.drawTurnable("scene");
      }),
    );
    by("scene-parts").replaceChildren(...chips);
  }

  /** Turn the pictures as a state has them. */
  view(state) {
    for (const name of Object.keys(USUAL)) {
      const view = state.views[name];
      this.views[name] = view?.length === USUAL[name].length ? view : USUAL[name];
    }
    this.draw();
  }

  /** Show the light of an answer. @param {object} state @param {object} answer */
  show(state, answer) {
    const names = Object.keys(answer.detectors);
    const name = names.includes(state.detector) ? state.detector : names[0];
    Object.assign(this, { answer, name, light: answer.detectors[name] });
    by("light").classList.remove("other");
    by("detector-choice").hidden = names.length < 2;
    by("detector-name").hidden = names.length > 1;
    by("detector-name").textContent = name;
    by("detector").replaceChildren(...names.map((each) => option(each)));
    by("detector").value = name;
    by("state").textContent = typeset(stateInWords(this.light));
    fillStokes(by("stokes"), name, this.light);
    fillQuantities(by("quantities"), name, this.light);
    fillAlong(by("along"), answer.along);
    say(by("model"), `Model ${answer.model}, method ${answer.method}, engine ${answer.engine}.`);
    this.drawLight();
    this.tell(lightInWords(name, this.light));
  }

  /** Show what has been found after the light. @param {object} answer @param {object} about */
  showMore(answer, about, fine = false) {
    const faults = answer.curve_faults ?? [];
    const curve = faults.length > 0 && about === this.about ? this.more.curve : answer.curve;
    Object.assign(this, { more: { ...answer, curve }, about });
    by("pictures").classList.remove("other");
    by("explanation").textContent = answer.explanation ?? "";
    say(by("curve-fault"), [...faults.map((each) => each.sentence), ...flat(curve)].join("\n"));
    canvasOf("curve").closest(".card").classList.toggle("stale", faults.length > 0);
    if (fine || !isTooFast(curve)) say(by("curve-notes"), tooFast(curve));
    this.drawMore();
  }

  /** Show nothing: there is no light. */
  clear() {
    Object.assign(this, { answer: null, more: null });
    for (const each of document.querySelectorAll("[data-picture] svg")) each.replaceChildren();
    for (const id of ["stokes", "quantities", "along", "explanation"]) by(id).replaceChildren();
    for (const id of ["state", "model", "scene-notes", "energy-notes"]) by(id).textContent = "";
  }

  draw() {
    this.drawLight();
    this.drawMore();
  }

  drawLight() {
    if (this.answer === null) return;
    drawEllipse(svgOf("ellipse"), this.name, this.light);
    this.drawTurnable("sphere");
  }

  drawMore() {
    if (this.more === null) return;
    const { curve, energy } = this.more;
    this.drawTurnable("scene");
    canvasOf("curve").hidden = !curve;
    if (curve)
      this.across = drawCurve(
        svgOf("curve"),
        curve,
        this.about.quantities.map((each) => each.name),
      );
    canvasOf("energy").hidden = !energy?.links.length;
    say(
      by("energy-notes"),
      typeset(
        [energy?.text, ...(energy?.notes ?? []).map((each) => `(${each})`)]
          .filter(Boolean)
          .join(" "),
      ),
    );
    if (energy?.links.length) drawEnergy(svgOf("energy"), energy);
  }

  drawTurnable(name) {
    if ((name === "sphere" ? this.answer : this.more) === null) return;
    if (name === "sphere") {
      drawSphere(svgOf("sphere"), this.views.sphere, this.name, this.light, this.answer.along);
      return;
    }
    const { scene } = this.more;
    canvasOf("scene").hidden = !scene;
    if (scene) drawScene(svgOf("scene"), scene, this.views.scene, this.parts);
    say(by("scene-notes"), typeset((scene?.notes ?? []).join("; ")));
  }

  /** Let a value be chosen by pointing at the curve. */
  onPointed(choose, settle) {
    const canvas = canvasOf("curve");
    let held = false;
    const point = (event) => {
      if (!held || !this.more?.curve) return;
      const box = svgOf("curve").getBoundingClientRect();
      choose(this.more.curve, this.across((event.clientX - box.left) / box.width));
    };
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      held = true;
      canvas.setPointerCapture(event.pointerId);
      point(event);
    });
    canvas.addEventListener("pointermove", point);
    for (const name of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(name, () => {
        if (held) settle();
        held = false;
      });
    }
  }
}

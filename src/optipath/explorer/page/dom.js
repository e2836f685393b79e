/** Elements of the page, made and found. */

/** @param {string} name @param {Object<string, any>} properties @returns {HTMLElement} */
export function element(name, properties = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(properties)) {
    if (key.includes("-") || key === "for" || key === "role") made.setAttribute(key, value);
    else made[key] = value;
  }
  made.append(...children);
  return made;
}

/** @param {string} id @returns {any} */
export const by = (id) => document.getElementById(id);

/** A button that is pressed or not. */
export function chip(words, pressed, click) {
  const made = element(
    "button",
    { type: "button", className: "chip", "aria-pressed": String(pressed) },
    words,
  );
  made.addEventListener("click", click);
  return made;
}

export function option(value, words = value) {
  return element("option", { value }, words);
}

/** Show a sentence, or hide its place. */
export function say(place, sentence) {
  if (place.textContent !== sentence) place.textContent = sentence;
  place.hidden = sentence === "";
}

/** Call `done` once no call has come for `delay` milliseconds. */
export function debounced(done, delay) {
  let timer = 0;
  const call = (...given) => {
    clearTimeout(timer);
    timer = setTimeout(() => done(...given), delay);
  };
  call.cancel = () => clearTimeout(timer);
  return call;
}

"""What is wrong with how the page looks, found by the browser itself."""

UNNAMED = """() => [...document.querySelectorAll('button, input, select, [tabindex="0"], svg')]
  .filter((each) => each.checkVisibility())
  .filter((each) => !(each.ariaLabel || each.labels?.length || each.textContent.trim()))
  .map((each) => each.outerHTML.slice(0, 120))"""
"""Controls and pictures that have no name."""

CONTRASTS = """() => {
  const parts = (colour) => colour.match(/[\\d.]+/g).map(Number);
  const ground = (each) => {
    for (let at = each; at; at = at.parentElement) {
      const found = parts(getComputedStyle(at).backgroundColor);
      if (found.length < 4 || found[3] > 0.99) return found;
    }
    return [255, 255, 255];
  };
  const light = ([r, g, b]) => [r, g, b]
    .map((each) => each / 255)
    .map((each) => (each <= 0.04045 ? each / 12.92 : ((each + 0.055) / 1.055) ** 2.4))
    .reduce((sum, each, i) => sum + each * [0.2126, 0.7152, 0.0722][i], 0);
  return [...document.querySelectorAll('body *')]
    .filter((each) => each.checkVisibility() && !each.matches(':disabled, .unseen, option'))
    .filter((each) => [...each.childNodes].some((child) => child.data?.trim()))
    .map((each) => {
      const colour = getComputedStyle(each)[each.matches('svg text') ? 'fill' : 'color'];
      const [one, other] = [light(parts(colour)), light(ground(each))].sort((a, b) => b - a);
      return [(one + 0.05) / (other + 0.05), each.textContent.trim().slice(0, 40)];
    })
    .filter(([contrast]) => contrast < 4.5);
}"""
"""Texts that hardly stand out from what they are written on, with their contrast."""

CUT = """() => [...document.querySelectorAll('svg[role=img]')].flatMap((svg) => {
  const room = svg.getBoundingClientRect();
  return [...svg.querySelectorAll('text')].filter((each) => {
    const box = each.getBoundingClientRect();
    const across = box.left < room.left - 1 || box.right > room.right + 1;
    return across || box.top < room.top - 1 || box.bottom > room.bottom + 1;
  }).map((each) => each.textContent);
})"""
"""The texts of pictures that reach out of them."""

OVER = """() => [...document.querySelectorAll('svg[role=img]')].flatMap((svg) => {
  const texts = [...svg.querySelectorAll('text')];
  const boxes = texts.map((each) => each.getBoundingClientRect());
  const over = (p, q) =>
    Math.min(p.right, q.right) - Math.max(p.left, q.left) > 2 &&
    Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top) > 5;
  return boxes.flatMap((box, i) =>
    texts
      .filter((_, k) => k > i && over(box, boxes[k]))
      .map((other) => texts[i].textContent + ' / ' + other.textContent));
})"""
"""The pairs of texts of pictures of which one is over the other."""

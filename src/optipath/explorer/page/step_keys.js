/** Ctrl+Z undoes; Ctrl+Shift+Z and Ctrl+Y redo, wherever the focus is. */

/** @param {() => void} undo @param {() => void} redo */
export function onStepKeys(undo, redo) {
  document.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    const key = event.key.toLowerCase();
    if (key === "z") (event.shiftKey ? redo : undo)();
    else if (key === "y") redo();
    else return;
    event.preventDefault();
  });
}

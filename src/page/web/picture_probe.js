// What stands at the pixel of a picture that one points at, and the traces that say why pixels are wrong.
//
// A row is a picture: { name, rgba, plane, traces }. `plane` holds the number of a cause for each wrong pixel, plus 128 if
// it is falsely lit; `traces` are some of these pixels: { x, y, command, text }. Both may be missing. A text is what the
// command prints; it may be empty.

const element = (parent, name, text, className) => {
  const made = document.createElement(name);
  if (text !== undefined) made.textContent = text;
  if (className) made.className = className;
  parent.append(made);
  return made;
};

// The trace of a pixel in a dialog, which Escape and its button close.
function openTrace(title, note, command, text) {
  const dialog = element(document.body, "dialog", undefined, "trace");
  const bar = element(dialog, "div", undefined, "bar-of-trace");
  dialog.setAttribute("aria-label", title);
  element(bar, "b", title);
  const close = element(bar, "button", "Close");
  close.type = "button";
  close.addEventListener("click", () => dialog.close());
  dialog.addEventListener("close", () => dialog.remove());
  if (note) element(dialog, "p", note, "note");
  const line = element(dialog, "pre", command, "command");
  const copy = element(dialog, "button", "Copy the command", "copy");
  copy.type = "button";
  copy.addEventListener("click", async () => {
    const copied = await Promise.resolve(navigator.clipboard?.writeText(command).then(() => true)).catch(() => false);
    getSelection().selectAllChildren(line);
    copy.textContent = copied ? "Copied" : "Selected: press Ctrl+C";  // not every page may write to the clipboard
  });
  if (text) element(dialog, "pre", text, "text").tabIndex = 0;
  dialog.showModal();
}

// The functions for the pictures of one part of a page, which are of this size. `causes`: the names that planes number.
//  watch(element, rowAt)  says in a line of `part` what stands under the pointer, and opens traces; rowAt(share) is the
//                         row shown at that share of the element's width
//  list(parent, row)      adds a button for each trace that has a text
export function pictureProbe(part, width, height, causes) {
  const line = element(part, "p", "Point at a picture: its pixel's values. Click a wrong pixel: its trace, which says why.", "note");
  line.setAttribute("role", "status");
  const valueAt = (row, x, y) => row.plane?.[y * width + x] ?? 0;
  const causeAt = (row, x, y) => causes[valueAt(row, x, y) & 127];
  const titleOf = (row, x, y) => `${row.name}, pixel ${x},${y}: ${causeAt(row, x, y)}`;
  const open = (row, one) => openTrace(titleOf(row, one.x, one.y), "", one.command, one.text);

  // The page has few traces: for another pixel it shows the nearest one of the same cause, beside the pixel's own command.
  function openNearest(row, x, y) {
    const far = (one) => Math.hypot(one.x - x, one.y - y);
    const known = row.traces.filter((one) => one.text && causeAt(row, one.x, one.y) === causeAt(row, x, y));
    const [nearest] = known.sort((a, b) => far(a) - far(b));
    if (nearest && far(nearest) === 0) return open(row, nearest);
    const command = row.traces[0].command.replace(/--pixel \S+(?= --ground-truth$)/, `--pixel ${x},${y}`);
    const note = nearest ? `This page has no trace of this pixel; the command makes it. Below: the nearest one of its cause, pixel ${nearest.x},${nearest.y}.` : "This page has no trace of this cause; the command makes it.";
    return openTrace(titleOf(row, x, y), note, command, nearest?.text);
  }

  function watch(shown, rowAt) {
    const found = (event) => {
      const box = shown.getBoundingClientRect();  // with the border, which is no part of the picture
      const across = (event.clientX - box.left - shown.clientLeft) / shown.clientWidth;
      const down = (event.clientY - box.top - shown.clientTop) / shown.clientHeight;
      if (!(across >= 0 && across < 1 && down >= 0 && down < 1)) return undefined;
      return { row: rowAt(across), x: Math.floor(across * width), y: Math.floor(down * height) };
    };
    shown.addEventListener("pointermove", (event) => {
      const one = found(event);
      if (!one) return;
      const { row, x, y } = one, at = 4 * (y * width + x), value = valueAt(row, x, y);
      const judgement = !row.plane ? "" : value === 0 ? ", right" : `, falsely ${value > 127 ? "lit" : "shadowed"}: ${causeAt(row, x, y)}`;
      line.textContent = `${row.name}, pixel ${x},${y}: ${[...row.rgba.slice(at, at + 3)].join(", ")}${judgement}`;
    });
    let pressed;  // where; the click at the end of a drag opens nothing
    shown.addEventListener("pointerdown", (event) => { pressed = event; });
    shown.addEventListener("click", (event) => {
      const one = found(event);
      if (pressed && Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) > 3) return;
      if (!one || valueAt(one.row, one.x, one.y) === 0) return;
      if (one.row.traces?.length) openNearest(one.row, one.x, one.y);
      else line.textContent = `Pixel ${one.x},${one.y}: no command draws this picture alone.`;
    });
  }

  function list(parent, row) {
    const known = (row.traces ?? []).filter((one) => one.text);
    if (known.length === 0) return;
    const buttons = element(parent, "p", "Traces: ", "traces");
    for (const one of known) {
      const button = element(buttons, "button", `${causeAt(row, one.x, one.y)} ${one.x},${one.y}`);
      button.type = "button";
      button.addEventListener("click", () => open(row, one));
    }
  }

  return { watch, list };
}

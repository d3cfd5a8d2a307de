// What stands at the pixel of a picture that one points at, and of a wrong one that is clicked the command that says why.

// Adds a line and a command to `part`. Returns watch(element, rowAt), where rowAt(share) is the row shown at that share of
// the element's width: { name, rgba, plane, command }. `plane` holds the number of a cause for each wrong pixel, plus 128
// if it is falsely lit; `command` is the trace of any pixel of the picture. Both may be missing.
export function pictureProbe(part, width, height, causes) {
  const line = document.createElement("p");
  line.className = "note";
  line.setAttribute("role", "status");
  line.textContent = "Point at a picture: its pixel's values. Click a wrong pixel: the command that says why.";
  const command = document.createElement("pre");
  command.className = "command";
  command.hidden = true;
  part.append(line, command);
  return (element, rowAt) => {
    const found = (event) => {
      const box = element.getBoundingClientRect();  // with the border, which is no part of the picture
      const across = (event.clientX - box.left - element.clientLeft) / element.clientWidth;
      const down = (event.clientY - box.top - element.clientTop) / element.clientHeight;
      if (!(across >= 0 && across < 1 && down >= 0 && down < 1)) return undefined;
      const x = Math.floor(across * width), y = Math.floor(down * height), row = rowAt(across);
      const at = y * width + x, value = row.plane?.[at] ?? 0;
      return { row, x, y, rgb: [...row.rgba.slice(4 * at, 4 * at + 3)], cause: causes[value & 127], wrong: value !== 0, lit: value > 127 };
    };
    element.addEventListener("pointermove", (event) => {
      const one = found(event);
      if (!one) return;
      const judgement = !one.row.plane ? "" : one.wrong ? `, falsely ${one.lit ? "lit" : "shadowed"}: ${one.cause}` : ", right";
      line.textContent = `${one.row.name}, pixel ${one.x},${one.y}: ${one.rgb.join(", ")}${judgement}`;
    });
    element.addEventListener("click", (event) => {
      const one = found(event), example = one?.row.command;
      command.hidden = !one?.wrong || !example;
      if (!command.hidden) command.textContent = example.replace(/--pixel \S+/, `--pixel ${one.x},${one.y}`);
    });
  };
}

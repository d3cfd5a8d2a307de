// Heat maps that show the value under the pointer, and sortable tables. It follows plots.js in one script.

const bytesOf = (base64) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));

// A map's list of values: little-endian floats, or numbers of one or two bytes of the values in the map's own list.
function listOf(map) {
  const bytes = bytesOf(map.values);
  const view = new DataView(bytes.buffer);
  if (!map.known) return Float32Array.from({ length: bytes.length / 4 }, (_, i) => view.getFloat32(4 * i, true));
  const known = Float32Array.from(map.known, (value) => (value === null ? NaN : value));
  if (map.known.length <= 256) return Float32Array.from(bytes, (number) => known[number]);
  return Float32Array.from({ length: bytes.length / 2 }, (_, i) => known[view.getUint16(2 * i, true)]);
}

// A map's values. Where they depend on x · y or x + y alone, the list has one for each product or sum, ascending.
function valuesOf(map) {
  const list = listOf(map);
  if (!map.by) return list;
  const signX = map.x_last < map.x_first ? -1 : 1, signY = map.y_last < map.y_first ? -1 : 1;
  const keys = Int32Array.from({ length: map.width * map.height }, (_, i) => {
    const x = map.x_first + signX * (i % map.width), y = map.y_first + signY * Math.floor(i / map.width);
    return map.by === "product" ? x * y : x + y;
  });
  const places = new Map();
  Int32Array.from(new Set(keys)).sort().forEach((key, place) => places.set(key, place));
  return Float32Array.from(keys, (key) => list[places.get(key)]);
}

// The index of a value in the colour ramp, by the same rule as in the PNG files.
function rampPlace(map, value) {
  let share = 0;
  if (map.low < 0) {
    const end = value < 0 ? -map.low : map.high;
    share = end > 0 ? value / end : 0;
  } else if (map.high > map.low) {
    share = Math.max((value - map.low) / (map.high - map.low), 0);
  }
  return 255 + Math.floor(Math.min(Math.max(share, -1), 1) * 255 + 0.5);
}

function paint(canvas, width, height, colorAt) {
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext("2d");
  const image = context.createImageData(width, height);
  for (let i = 0; i < width * height; ++i) image.data.set(colorAt(i), 4 * i);
  context.putImageData(image, 0, 0);
}

data.maps.forEach((map, number) => {
  const figure = document.getElementById("map-" + number);
  const canvas = figure.querySelector(".field canvas");
  const told = figure.querySelector(".value");
  const mark = figure.querySelector(".at");
  const values = valuesOf(map);
  const ramp = bytesOf(data.ramps[map.low < 0 ? 1 : 0]);
  const colorOf = (value) => {
    if (Number.isNaN(value)) return [128, 128, 128, 255];
    const place = 3 * rampPlace(map, value);
    return [ramp[place], ramp[place + 1], ramp[place + 2], 255];
  };
  paint(canvas, map.width, map.height, (i) => colorOf(values[i]));
  canvas.style.width = `${map.width * Math.max(1, Math.floor(512 / Math.max(map.width, map.height)))}px`;
  const steps = map.low < 0 ? 255 * 2 : 255;
  paint(figure.querySelector(".scale canvas"), steps + 1, 1, (i) => {
    const place = 3 * (map.low < 0 ? i : 255 + i);
    return [ramp[place], ramp[place + 1], ramp[place + 2], 255];
  });

  let column = 0, row = 0;
  const along = (letter, i, count) => {
    const first = map[letter + "_first"], last = map[letter + "_last"];
    return map[letter + "_values"]?.[i] ?? (count > 1 ? first + ((last - first) * i) / (count - 1) : first);
  };
  const tell = () => {
    const value = values[row * map.width + column];
    const x = shown(along("x", column, map.width));
    const y = shown(along("y", row, map.height));
    const strong = document.createElement("b");
    // Floats have no reliable seventh digit.
    strong.textContent = Number.isNaN(value) ? map.none : shown(Number.isInteger(value) ? value : +value.toPrecision(6));
    told.classList.add("told");
    told.replaceChildren(`${map.x_label || "x"} ${x}, ${map.y_label || "y"} ${y}: `, strong);
    mark.hidden = false;
    mark.style.left = `${((column + 0.5) / map.width) * 100}%`;
    mark.style.top = `${((row + 0.5) / map.height) * 100}%`;
  };
  const within = (i, count) => Math.min(Math.max(i, 0), count - 1);
  const follow = (event) => {
    const box = canvas.getBoundingClientRect();
    column = within(Math.floor(((event.clientX - box.left) / box.width) * map.width), map.width);
    row = within(Math.floor(((event.clientY - box.top) / box.height) * map.height), map.height);
    tell();
  };
  canvas.addEventListener("pointermove", follow);
  canvas.addEventListener("pointerdown", follow);
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!step) return;
    event.preventDefault();
    const size = event.shiftKey ? 16 : 1;
    column = within(column + size * step[0], map.width);
    row = within(row + size * step[1], map.height);
    tell();
  });
});

// Orders numbers by value and texts alphabetically; empty cells come last in both directions.
function compared(a, b, sign) {
  if (a === "" || b === "") return (a === "") - (b === "");
  const x = Number(a), y = Number(b);
  if (!Number.isNaN(x) && !Number.isNaN(y)) return sign * (x - y || 0);
  return sign * a.localeCompare(b, "en", { numeric: true });
}

const valueOf = (cell) => cell.dataset.v ?? cell.textContent;

for (const table of document.querySelectorAll("table.sorts")) {
  const heads = [...table.tHead.rows[0].cells];
  const body = table.tBodies[0];
  heads.forEach((head, column) => {
    head.querySelector("button").addEventListener("click", () => {
      const up = head.getAttribute("aria-sort") !== "ascending";
      for (const other of heads) other.setAttribute("aria-sort", "none");
      head.setAttribute("aria-sort", up ? "ascending" : "descending");
      const keyed = [...body.rows].map((row) => [valueOf(row.cells[column]), row]);
      keyed.sort((a, b) => compared(a[0], b[0], up ? 1 : -1));
      body.append(...keyed.map(([, row]) => row));
    });
  });
  const all = body.rows.length;
  if (all <= 50) continue;
  table.classList.add("cut");
  const button = document.createElement("button");
  button.type = "button";
  button.className = "all";
  button.textContent = `Show all ${shown(all)} rows`;
  button.addEventListener("click", () => {
    table.classList.remove("cut");
    button.remove();
  });
  table.closest(".table").append(button);
}

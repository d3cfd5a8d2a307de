// The page's own script: plots by Chart.js, heat maps with the value under the pointer, tables that sort.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// As many digits as people read: whole numbers in full, others with seven that count.
function shown(value) {
  if (Number.isInteger(value) && Math.abs(value) < 1e4) return String(value);
  if (Number.isInteger(value) && Math.abs(value) < 1e15) return value.toLocaleString("en").replace(/,/g, "\u202f");
  return Number.isFinite(value) ? String(Number(value.toPrecision(7))) : String(value);
}

const raised = (exponent) => String(exponent).replace(/[-0-9]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);

// On a logarithmic axis powers of ten have labels, and where there are few of them also 2 and 5 times them.
function logLabel(value) {
  const exponent = Math.floor(Math.log10(value) + 1e-9);
  const factor = Math.round(value / 10 ** exponent);
  const decades = Math.log10(this.max / this.min);
  if (factor !== 1 && !(decades <= 2 && (factor === 2 || factor === 5))) return "";
  return exponent >= -3 && exponent <= 3 ? shown(value) : `${factor === 1 ? "" : factor + " · "}10${raised(exponent)}`;
}

function axis(plot, letter) {
  const logarithmic = plot["log_" + letter] && !(plot.bars && letter === "x");
  const label = plot[letter + "_label"];
  const ticks = { color: css("--quiet") };
  const line = css("--rule");
  if (logarithmic) ticks.callback = logLabel;
  const made = {
    title: { display: label !== "", text: label, color: css("--ink") },
    // On a logarithmic axis Chart.js thins out the lines without a label unevenly.
    grid: { color: (context) => (context.tick?.label === "" ? "transparent" : line), borderColor: css("--quiet") },
    ticks,
  };
  if (!(plot.bars && letter === "x")) made.type = logarithmic ? "logarithmic" : "linear";
  return made;
}

function optionsOf(plot) {
  const isBars = plot.bars;
  return {
    animation: false,
    maintainAspectRatio: false,
    locale: "en",
    interaction: isBars ? { mode: "index", intersect: false } : { mode: "nearest", axis: "x", intersect: false },
    scales: { x: axis(plot, "x"), y: { ...axis(plot, "y"), ...(isBars && !plot.log_y ? { beginAtZero: true } : {}) } },
    plugins: {
      legend: {
        display: plot.series.length > 1,
        position: "bottom",
        labels: { color: css("--ink"), usePointStyle: true, boxWidth: 8, boxHeight: 8, padding: 14 },
      },
      tooltip: {
        usePointStyle: true,
        callbacks: {
          title: (items) => {
            if (items.length === 0) return "";
            const x = isBars ? items[0].label : shown(items[0].parsed.x);
            return plot.x_label === "" ? x : `${plot.x_label}: ${x}`;
          },
          label: (item) => {
            const name = plot.series[item.datasetIndex].name;
            return name === "" ? shown(item.parsed.y) : `${name}: ${shown(item.parsed.y)}`;
          },
        },
      },
    },
  };
}

function datasetOf(series, number, plot) {
  const color = data.palette[number % data.palette.length];
  return {
    label: series.name,
    data: series.points,
    borderColor: color,
    backgroundColor: color,
    pointStyle: plot.bars ? "rect" : ["circle", "rect", "triangle", "rectRot"][number % 4],
    borderDash: Math.floor(number / data.palette.length) % 2 === 1 ? [6, 5] : [],
    borderWidth: plot.bars ? 0 : 2,
    pointRadius: series.points.length > 60 ? 0 : 3.5,
    pointHoverRadius: 5,
    showLine: true,
    tension: 0,
  };
}

const charts = data.plots.map((plot, number) => {
  const canvas = document.getElementById("plot-" + number);
  // Room for the legend, which stands below in rows.
  const rows = plot.series.length > 1 ? Math.ceil((plot.series.length * 190) / Math.max(canvas.parentNode.clientWidth, 300)) : 0;
  canvas.parentNode.style.height = `${370 + Math.min(rows, 20) * 26}px`;
  Chart.defaults.font.family = css("--sans");
  Chart.defaults.font.size = 13;
  const chart = new Chart(canvas, {
    type: plot.bars ? "bar" : "scatter",
    data: { labels: plot.labels, datasets: plot.series.map((series, i) => datasetOf(series, i, plot)) },
    options: optionsOf(plot),
  });
  return { chart, plot };
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  for (const { chart, plot } of charts) {
    chart.options = optionsOf(plot);
    chart.update();
  }
});

const bytesOf = (base64) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));

// A map's values: little-endian floats, or a byte each that numbers an entry of the map's own list.
function valuesOf(map) {
  const bytes = bytesOf(map.values);
  if (map.known) return Float32Array.from(bytes, (i) => (map.known[i] === null ? NaN : map.known[i]));
  const view = new DataView(bytes.buffer);
  return Float32Array.from({ length: bytes.length / 4 }, (_, i) => view.getFloat32(4 * i, true));
}

// The place of a value in the colour ramp; the same rule as in the picture files.
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
  const along = (first, last, i, count) => (count > 1 ? first + ((last - first) * i) / (count - 1) : first);
  const tell = () => {
    const value = values[row * map.width + column];
    const x = shown(along(map.x_first, map.x_last, column, map.width));
    const y = shown(along(map.y_first, map.y_last, row, map.height));
    const strong = document.createElement("b");
    // Floats have no seventh digit to show.
    strong.textContent = Number.isNaN(value) ? "none" : shown(Number.isInteger(value) ? value : +value.toPrecision(6));
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

// Numbers by their size, texts by the alphabet, what has no value last in either direction.
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

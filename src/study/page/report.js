// The page's own script: plots with Chart.js, heat maps that show the value under the pointer, sortable tables.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// A number for people: whole numbers in full, others with seven significant digits.
function shown(value) {
  if (Number.isInteger(value) && Math.abs(value) < 1e4) return String(value);
  if (Number.isInteger(value) && Math.abs(value) < 1e15) return value.toLocaleString("en").replace(/,/g, "\u202f");
  return Number.isFinite(value) ? String(Number(value.toPrecision(7))) : String(value);
}

const raised = (exponent) => String(exponent).replace(/[-0-9]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);

// Labels of a logarithmic axis: powers of ten and, if these are few, also 2 and 5 times powers of ten.
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
  const line = css("--rule");
  const ticks = { color: css("--quiet") };
  if (logarithmic) Object.assign(ticks, { callback: logLabel, autoSkip: false, maxRotation: 0 });
  if (!logarithmic && !(plot.bars && letter === "x")) ticks.callback = (value) => shown(+value.toPrecision(10));
  const made = {
    title: { display: label !== "", text: label, color: css("--ink") },
    // Hides unlabelled lines, because Chart.js thins them out unevenly on a logarithmic axis.
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
      legend: { display: false },
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

// The look of a series: its colour, and its points and dashes for readers who do not see colours.
const lookOf = (number) => ({
  color: data.palette[number % data.palette.length],
  point: number % 4,
  dashes: Math.floor(number / data.palette.length) % 2 === 1 ? [6, 5] : [],
});

function datasetOf(series, number, plot) {
  const { color, point, dashes } = lookOf(number);
  return {
    label: series.name,
    data: series.points,
    borderColor: color,
    backgroundColor: color,
    pointStyle: plot.bars ? "rect" : ["circle", "rect", "triangle", "rectRot"][point],
    borderDash: dashes,
    borderWidth: plot.bars ? 0 : 2,
    pointRadius: series.points.length > 60 ? 0 : 3.5,
    pointHoverRadius: 5,
    showLine: true,
    tension: 0,
  };
}

function svg(name, attributes) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
}

// One button per series, which hides or shows it. Chart.js's own legend is part of the canvas: the keyboard cannot reach
// it, and it leaves out entries that do not fit.
function legendOf(plot, chart) {
  const list = document.createElement("ul");
  list.className = "legend";
  plot.series.forEach((series, number) => {
    const { color, point, dashes } = lookOf(number);
    const sample = svg("svg", { width: 30, height: 12, "aria-hidden": "true" });
    if (!plot.bars) {
      sample.append(svg("path", { d: "M1 6H29", stroke: color, "stroke-width": 2, "stroke-dasharray": dashes.join(" ") }));
    }
    const shapes = ["M15 2a4 4 0 0 1 0 8a4 4 0 0 1 0-8", "M11 2h8v8h-8z", "M15 1l5 9h-10z", "M15 1l5 5l-5 5l-5-5z"];
    sample.append(svg("path", { d: plot.bars ? "M9 0h12v12h-12z" : shapes[point], fill: color }));
    const button = document.createElement("button");
    button.type = "button";
    button.setAttribute("aria-pressed", "true");
    button.append(sample, series.name);
    button.addEventListener("click", () => {
      chart.setDatasetVisibility(number, !chart.isDatasetVisible(number));
      button.setAttribute("aria-pressed", chart.isDatasetVisible(number));
      chart.update();
    });
    list.append(document.createElement("li"));
    list.lastChild.append(button);
  });
  return list;
}

Chart.defaults.font.family = css("--sans");
Chart.defaults.font.size = 13;
const charts = data.plots.map((plot, number) => {
  const canvas = document.getElementById("plot-" + number);
  const chart = new Chart(canvas, {
    type: plot.bars ? "bar" : "scatter",
    data: { labels: plot.labels, datasets: plot.series.map((series, i) => datasetOf(series, i, plot)) },
    options: optionsOf(plot),
  });
  if (plot.series.length > 1) canvas.parentNode.after(legendOf(plot, chart));
  return { chart, plot };
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  for (const { chart, plot } of charts) {
    chart.options = optionsOf(plot);
    chart.update();
  }
});

const bytesOf = (base64) => Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));

// A map's values: little-endian floats, or one byte per value, an index into the map's own list.
function valuesOf(map) {
  const bytes = bytesOf(map.values);
  if (map.known) return Float32Array.from(bytes, (i) => (map.known[i] === null ? NaN : map.known[i]));
  const view = new DataView(bytes.buffer);
  return Float32Array.from({ length: bytes.length / 4 }, (_, i) => view.getFloat32(4 * i, true));
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
  const along = (first, last, i, count) => (count > 1 ? first + ((last - first) * i) / (count - 1) : first);
  const tell = () => {
    const value = values[row * map.width + column];
    const x = shown(along(map.x_first, map.x_last, column, map.width));
    const y = shown(along(map.y_first, map.y_last, row, map.height));
    const strong = document.createElement("b");
    // Floats have no reliable seventh digit.
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

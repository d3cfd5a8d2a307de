// Plots with Chart.js. It follows values.js in one script.

const raised = (exponent) => String(exponent).replace(/[-0-9]/g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);

// Labels of a logarithmic axis: powers of ten and, if these are few, also 2 and 5 times powers of ten.
function logLabel(value) {
  const exponent = Math.floor(Math.log10(value) + 1e-9);
  const factor = Math.round(value / 10 ** exponent);
  const decades = Math.log10(this.max / this.min);
  if (factor !== 1 && !(decades <= 2 && (factor === 2 || factor === 5))) return "";
  return exponent >= -3 && exponent <= 3 ? shown(value) : `${factor === 1 ? "" : factor + " · "}10${raised(exponent)}`;
}

// The different coordinates of a plot's visible series, ascending.
function coordinatesOf(plot, letter) {
  const all = new Set();
  plot.series.forEach((series, number) => {
    if (plot.hidden.has(number)) return;
    series.points.forEach((point) => {
      const value = letter === "y" && plot.even ? point : point?.[letter];
      if (value !== null && value !== undefined) all.add(value);
    });
  });
  return [...all].sort((a, b) => a - b);
}

// The nearest 1, 2 or 5 times a power of ten that is not above the value; with `up`, not below it.
function roundEnd(value, up) {
  const power = 10 ** Math.floor(Math.log10(value) + 1e-9);
  const ends = [1, 2, 5, 10].map((factor) => factor * power);
  return up ? ends.find((end) => end >= value * (1 - 1e-9)) : ends.filter((end) => end <= value * (1 + 1e-9)).pop();
}

// The ends of a linear axis: those of its points, or round numbers that are near to them.
function linearEnds(least, most) {
  const range = most - least, step = roundEnd(range / 10, true);
  const low = Math.floor(least / step) * step, high = Math.ceil(most / step) * step;
  return { min: least - low < 0.02 * range ? low : least, max: high - most < 0.02 * range ? high : most };
}

// Ends and ticks of an axis with numbers. The axis x ends with its points; few points of a logarithmic one are its
// ticks. Whole numbers have no fractions between them.
function scaleOf(plot, letter) {
  const values = coordinatesOf(plot, letter);
  const least = values[0], most = values[values.length - 1];
  if (!plot["log_" + letter]) {
    const ends = letter === "x" && least < most ? linearEnds(least, most) : {};
    const ticks = {
      callback: (value) => shown(+value.toPrecision(10)),
      ...(values.every(Number.isInteger) ? { precision: 0 } : {}),
      ...(letter === "x" ? { includeBounds: false } : {}),
    };
    return { type: "linear", ticks, ...ends };
  }
  const made = { type: "logarithmic", ticks: { callback: logLabel, autoSkip: false, maxRotation: 0 } };
  if (values.length === 0) return made;
  if (letter === "x" && values.length > 1 && values.length <= 12) {
    made.ticks.callback = (value) => shown(value);
    made.afterBuildTicks = (scale) => (scale.ticks = values.map((value) => ({ value })));
    return { ...made, min: least, max: most };
  }
  const low = roundEnd(least, false), high = roundEnd(most, true);
  return { ...made, min: low, max: high > low ? high : 10 * low };
}

function axis(plot, letter) {
  const label = plot[letter + "_label"];
  const line = css("--rule");
  const made = plot.even && letter === "x" ? { ticks: {} } : scaleOf(plot, letter);
  made.ticks.color = css("--quiet");
  made.title = { display: label !== "", text: label, color: css("--ink") };
  // Hides unlabelled lines, because Chart.js thins them out unevenly on a logarithmic axis.
  made.grid = { color: (context) => (context.tick?.label === "" ? "transparent" : line), borderColor: css("--quiet") };
  return made;
}

function optionsOf(plot) {
  const isBars = plot.bars, isEven = plot.even;
  return {
    animation: false,
    maintainAspectRatio: false,
    locale: "en",
    interaction: isEven ? { mode: "index", intersect: false } : { mode: "nearest", axis: "x", intersect: false },
    scales: { x: axis(plot, "x"), y: { ...axis(plot, "y"), ...(isBars && !plot.log_y ? { beginAtZero: true } : {}) } },
    plugins: {
      legend: { display: false },
      tooltip: {
        usePointStyle: true,
        callbacks: {
          title: (items) => {
            if (items.length === 0) return "";
            const x = isEven ? items[0].label : shown(items[0].parsed.x);
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
    hidden: plot.hidden.has(number),
    clip: false,
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
      const visible = plot.hidden.delete(number);
      if (!visible) plot.hidden.add(number);
      chart.setDatasetVisibility(number, visible);
      button.setAttribute("aria-pressed", visible);
      chart.options = optionsOf(plot);
      chart.update();
    });
    list.append(document.createElement("li"));
    list.lastChild.append(button);
  });
  return list;
}

const configOf = (plot) => ({
  type: plot.bars ? "bar" : plot.even ? "line" : "scatter",
  data: { labels: plot.labels, datasets: plot.series.map((series, i) => datasetOf(series, i, plot)) },
  options: optionsOf(plot),
});

// Draws the plot once more, with its title and legend, and saves that picture.
function savePlot(plot) {
  const canvas = document.createElement("canvas");
  canvas.width = 1280;
  canvas.height = 800;
  const config = configOf(plot);
  Object.assign(config.options, { responsive: false, devicePixelRatio: 1, layout: { padding: 24 } });
  config.options.plugins.title = { display: true, text: plot.title, color: css("--ink"), font: { size: 22 } };
  config.options.plugins.legend = {
    display: plot.series.length > 1,
    position: "bottom",
    labels: { color: css("--ink"), usePointStyle: true },
  };
  const paper = (chart) => {
    chart.ctx.fillStyle = css("--paper");
    chart.ctx.fillRect(0, 0, chart.width, chart.height);
  };
  config.plugins = [{ id: "paper", beforeDraw: paper }];
  const chart = new Chart(canvas, config);
  const link = document.createElement("a");
  link.href = canvas.toDataURL("image/png");
  link.download = plot.file + ".png";
  link.click();
  chart.destroy();
}

function saveButtonOf(plot) {
  const button = document.createElement("button");
  button.type = "button";
  button.className = "save";
  button.textContent = "Save as PNG";
  button.setAttribute("aria-label", `Save as PNG: ${plot.title}`);
  button.addEventListener("click", () => savePlot(plot));
  return button;
}

Chart.defaults.font.family = css("--sans");
Chart.defaults.font.size = 13;
const charts = data.plots.map((plot, number) => {
  const canvas = document.getElementById("plot-" + number);
  plot.hidden = new Set();
  const chart = new Chart(canvas, configOf(plot));
  canvas.parentNode.after(...(plot.series.length > 1 ? [legendOf(plot, chart)] : []), saveButtonOf(plot));
  return { chart, plot };
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  for (const { chart, plot } of charts) {
    chart.options = optionsOf(plot);
    chart.update();
  }
});

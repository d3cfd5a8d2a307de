// The page of `ninebit compare`. Its data are in the element "data"; every name is shown as text.
import { pictureProbe } from "../../page/web/picture_probe.js";
import { pictureSwipe } from "../../page/web/picture_swipe.js";
import { sortableTable } from "../../page/web/sortable_table.js";
import { causeColors, causeHelp, heatStops, wrongPixels } from "../../page/web/wrong_pixels.js";

const data = JSON.parse(document.getElementById("data").textContent);
const [pictureWidth, pictureHeight] = data.size;
const drawn = data.rows.filter((row) => row.color);
const { pixelsOf, pointsOf, densityOf, heatOf, heatRadius } = wrongPixels(pictureWidth, pictureHeight, data.causes);
const judged = drawn.filter((row) => row.wrong_pixels);

const grouped = (value) => (value === null || value === undefined ? value : value.toLocaleString("en").replace(/,/g, "\u202f"));

function add(parent, name, text, className) {
  const element = document.createElement(name);
  if (text !== undefined) element.textContent = text;
  if (className) element.className = className;
  parent.append(element);
  return element;
}

function section(parent, title, text) {
  const element = add(parent, "section");
  const heading = add(element, "h2", title);
  heading.id = title.toLowerCase().replace(/[^a-z]+/g, "-");
  element.setAttribute("aria-labelledby", heading.id);
  if (text) add(element, "p", text);
  return element;
}

// ---- The parts of the page

function addHeader(page) {
  const header = add(page, "header");
  add(header, "p", `ninebit ${data.version} compare`, "kind");
  add(header, "h1", data.vary.length === 0 ? "Techniques side by side" : "Settings side by side");
  const facts = add(header, "dl");
  const fact = (name, value) => {
    add(facts, "dt", name);
    add(facts, "dd", value);
  };
  fact("Scene", `${data.scene}, ${grouped(data.triangles)} triangles`);
  fact("Light", data.light);
  fact("Picture", `${pictureWidth} × ${pictureHeight} pixels`);
  fact("Profile", data.vary.some((text) => /^-*profile=/.test(text)) ? "varied" : data.profile);
  if (data.vary.length > 0) fact("Varied", data.vary.join("; "));
  if (data.made_by) fact("Command", data.made_by);
  if (data.ignored.length > 0) fact("Ignored", data.ignored.join("; "));
  for (const reason of new Set(data.left_out.map((one) => one.reason))) {
    const names = data.left_out.filter((one) => one.reason === reason).map((one) => one.technique);
    fact("Left out", `${names.join(", ")}: ${reason}`);
  }
  for (const row of data.rows.filter((one) => one.refused)) fact("Not drawn", `${row.name}: ${row.refused}`);
}

function choiceOf(parent, text, names, chosen, changed) {
  const label = add(parent, "label", text);
  const select = add(label, "select");
  names.forEach((name, number) => {
    const option = add(select, "option", name);
    option.value = String(number);
  });
  select.value = String(chosen);
  select.addEventListener("change", () => changed(Number(select.value)));
  return select;
}

function addPictures(page) {
  const part = section(page, "Pictures", "Drag the divider, or move it with the arrow keys.");
  const controls = add(part, "div", undefined, "controls");
  const pair = { left: 0, right: Math.min(1, drawn.length - 1) };
  const swipe = pictureSwipe(pictureWidth, pictureHeight);
  let marked = false;
  const show = (side) => {
    const row = drawn[pair[side]];
    swipe.show(side, { name: row.name, url: row.color, overlay: marked && row.plane ? pointsOf(row, 0) : undefined });
  };
  const names = drawn.map((row) => row.name);
  const selects = {};
  for (const side of ["left", "right"]) {
    selects[side] = choiceOf(controls, side === "left" ? "Left " : "Right ", names, pair[side], (number) => {
      pair[side] = number;
      show(side);
    });
  }
  const swap = add(controls, "button", "Swap");
  swap.type = "button";
  swap.addEventListener("click", () => {
    [pair.left, pair.right] = [pair.right, pair.left];
    for (const side of ["left", "right"]) {
      selects[side].value = String(pair[side]);
      show(side);
    }
  });
  if (judged.length > 0) {
    const label = add(controls, "label", undefined, "check");
    const box = add(label, "input");
    box.type = "checkbox";
    label.append(" Mark wrong pixels");
    box.addEventListener("change", () => {
      marked = box.checked;
      for (const side of ["left", "right"]) show(side);
    });
  }
  part.append(swipe.element);
  const divider = swipe.element.querySelector("[role=slider]");
  pictureProbe(part, pictureWidth, pictureHeight, data.causes).watch(swipe.element, (across) => drawn[pair[100 * across < Number(divider.ariaValueNow) ? "left" : "right"]]);
  for (const side of ["left", "right"]) show(side);
}

function addTable(page) {
  const part = section(page, "Figures", "Click a heading to sort. Wrong pixels differ from what rays find.");
  const wrong = (key) => (row) => row.errors?.[key];
  const known = data.causes.filter((name) => judged.some((row) => row.errors.by_cause[name] > 0));
  const columns = [
    { title: "Name", value: (row) => row.name },
    { title: "Wrong pixels", number: true, value: wrong("wrong"), text: (row) => grouped(row.errors?.wrong) },
    {
      title: "% of scene",
      number: true,
      help: "of the pixels that show the scene",
      value: (row) => (row.errors ? (100 * row.errors.wrong) / Math.max(1, row.pixels.lit + row.pixels.shadowed) : null),
      text: (row) => (row.errors ? ((100 * row.errors.wrong) / Math.max(1, row.pixels.lit + row.pixels.shadowed)).toFixed(2) : null),
    },
    { title: "Time ms", number: true, value: (row) => row.time_ms?.total, text: (row) => row.time_ms?.total.toFixed(1) },
    { title: "Texture units", number: true, help: "that the comparison reads", value: (row) => row.texture_units },
    { title: "Passes", number: true, value: (row) => row.passes },
    {
      title: "Maps KiB",
      number: true,
      help: "memory of the light's maps as textures",
      value: (row) => row.map_bytes,
      text: (row) => (row.map_bytes === undefined ? null : grouped(Math.round(row.map_bytes / 1024))),
    },
    { title: "Falsely lit", number: true, value: wrong("false_lit"), text: (row) => grouped(row.errors?.false_lit) },
    { title: "Falsely shadowed", number: true, value: wrong("false_shadowed"), text: (row) => grouped(row.errors?.false_shadowed) },
    ...known.map((name) => ({
      title: name[0].toUpperCase() + name.slice(1),
      number: true,
      help: causeHelp[name],
      value: (row) => row.errors?.by_cause[name],
      text: (row) => grouped(row.errors?.by_cause[name]),
    })),
  ];
  const scroll = add(part, "div", undefined, "scroll");
  scroll.tabIndex = 0;
  scroll.setAttribute("role", "region");
  scroll.setAttribute("aria-label", "Figures; scrolls sideways");
  scroll.append(sortableTable(columns, data.rows, { sorted: 1, label: "Figures of all renderings" }));
  add(part, "p", "A dash: there is no such figure. Time is that of one rendering on the machine that made this page, without the rays. Texture units are those that the comparison of the shadow reads; a comparison in floats, which no such hardware has, has none. A pass draws the scene, its shadow volumes or a rectangle of the picture's size. Memory is that of the light's maps, without the depth buffer that drawing them takes.", "note");
}

function addLegend(part) {
  const list = add(part, "ul", undefined, "legend");
  for (const name of data.causes) {
    const count = judged.reduce((sum, row) => sum + (row.errors.by_cause[name] ?? 0), 0);
    if (count === 0) continue;
    const item = add(list, "li");
    add(item, "span", undefined, "chip").style.background = causeColors[name];
    add(item, "b", name);
    item.append(` ${causeHelp[name]}`);
  }
}

function addMaps(page) {
  const part = section(page, "Wrong pixels");
  if (judged.length === 0) return void add(part, "p", "No shadows were drawn.");
  const controls = add(part, "div", undefined, "controls");
  const known = data.causes.map((name, number) => ({ name, number })).filter(({ name }) => judged.some((row) => row.errors.by_cause[name] > 0));
  let cause = 0, points = false;
  const paint = () => {
    const densities = points ? [] : judged.map((row) => densityOf(row, cause));
    const most = densities.reduce((high, plane) => plane.reduce((a, b) => Math.max(a, b), high), 1e-9);
    judged.forEach((row, i) => {
      const overlay = points ? pointsOf(row, cause) : heatOf(densities[i], most);
      const context = row.map.getContext("2d");
      context.globalCompositeOperation = "source-over";
      context.filter = "grayscale(1) brightness(0.55)";
      context.drawImage(row.picture, 0, 0);
      context.filter = "none";
      context.drawImage(overlay, 0, 0);
      const count = cause === 0 ? row.errors.wrong : (row.errors.by_cause[data.causes[cause]] ?? 0);
      row.count.textContent = ` ${grouped(count)} ${count === 1 ? "pixel" : "pixels"}`;
    });
    scale.hidden = points;
    high.textContent = `${Number((100 * Math.min(1, most)).toPrecision(most < 0.1 ? 2 : 3))} % wrong`;
  };
  choiceOf(controls, "Cause ", ["all causes", ...known.map(({ name }) => name)], 0, (number) => {
    cause = number === 0 ? 0 : known[number - 1].number;
    paint();
  });
  choiceOf(controls, "Show ", ["heat map", "single pixels in the colour of their cause"], 0, (number) => {
    points = number === 1;
    paint();
  });
  addLegend(part);
  const scale = add(part, "p", undefined, "scale");
  add(scale, "span", "few");
  const bar = add(scale, "span", undefined, "bar");
  bar.style.background = `linear-gradient(to right, ${heatStops.map((rgb) => `rgb(${rgb})`).join(", ")})`;
  const high = add(scale, "span");
  scale.append(` in squares of ${2 * heatRadius + 1} pixels; the same scale for all pictures, by square roots`);
  const { watch, list } = pictureProbe(part, pictureWidth, pictureHeight, data.causes);
  const grid = add(part, "div", undefined, "maps");
  for (const row of judged) {
    const figure = add(grid, "figure");
    row.map = add(figure, "canvas");
    row.map.width = pictureWidth;
    row.map.height = pictureHeight;
    watch(row.map, () => row);
    row.map.setAttribute("role", "img");
    row.map.setAttribute("aria-label", `Wrong pixels of ${row.name}`);
    const caption = add(figure, "figcaption");
    add(caption, "b", row.name);
    row.count = add(caption, "span");
    list(figure, row);
  }
  paint();
}

async function load(row) {
  row.picture = new Image();
  row.picture.src = row.color;
  await row.picture.decode();
  const context = new OffscreenCanvas(pictureWidth, pictureHeight).getContext("2d", { willReadFrequently: true });
  context.drawImage(row.picture, 0, 0);
  row.rgba = context.getImageData(0, 0, pictureWidth, pictureHeight).data;
  if (row.wrong_pixels) row.plane = await pixelsOf(row.wrong_pixels);
}

await Promise.all(drawn.map(load));
const page = document.createElement("main");
document.body.append(page);
addHeader(page);
addPictures(page);
addTable(page);
addMaps(page);

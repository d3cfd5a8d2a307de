// Used by all parts of the page's own script: the report's data, colours, numbers for people.
"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// A number for people: whole numbers in full, others with seven significant digits.
function shown(value) {
  if (Number.isInteger(value) && Math.abs(value) < 1e4) return String(value);
  if (Number.isInteger(value) && Math.abs(value) < 1e15) return value.toLocaleString("en").replace(/,/g, "\u202f");
  return Number.isFinite(value) ? String(Number(value.toPrecision(7))) : String(value);
}

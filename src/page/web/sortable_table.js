// A table whose rows are sorted by the column that is clicked, or chosen with the keyboard.

// Missing values come last in both directions.
function orderOfCells(a, b, descending) {
  const missing = (value) => value === null || value === undefined || value === "";
  if (missing(a) || missing(b)) return missing(a) - missing(b);
  const order = typeof a === "number" && typeof b === "number" ? a - b : String(a).localeCompare(String(b), "en");
  return descending ? -order : order;
}

// `columns`: [{ title, value(row), text?(row), number? (right-aligned), help? }]; `rows`: any objects. `sorted`: the
// column by which the rows are sorted first. Every text is shown as text. Returns the table.
export function sortableTable(columns, rows, { sorted = 0, label = "" } = {}) {
  const table = document.createElement("table");
  if (label) table.setAttribute("aria-label", label);
  const head = table.createTHead().insertRow();
  const body = table.createTBody();
  let by = sorted;
  let descending = false;

  const lines = rows.map((row) => {
    const line = document.createElement("tr");
    columns.forEach((column, number) => {
      const cell = document.createElement(number === 0 ? "th" : "td");
      if (number === 0) cell.scope = "row";
      if (column.number) cell.className = "n";
      const value = column.value(row);
      const text = column.text ? column.text(row) : value;
      cell.textContent = text === null || text === undefined ? "–" : String(text);
      line.append(cell);
    });
    return { row, line };
  });

  function sort() {
    const value = columns[by].value;
    const order = [...lines].sort((a, b) => orderOfCells(value(a.row), value(b.row), descending));
    body.append(...order.map(({ line }) => line));
    [...head.cells].forEach((cell, number) => {
      if (number === by) cell.setAttribute("aria-sort", descending ? "descending" : "ascending");
      else cell.removeAttribute("aria-sort");
    });
  }

  columns.forEach((column, number) => {
    const cell = document.createElement("th");
    cell.scope = "col";
    if (column.number) cell.className = "n";
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = column.title;
    if (column.help) button.title = column.help;
    button.addEventListener("click", () => {
      descending = by === number && !descending;
      by = number;
      sort();
    });
    cell.append(button);
    head.append(cell);
  });
  sort();
  return table;
}

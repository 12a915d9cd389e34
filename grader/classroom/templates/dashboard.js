"use strict";
const find = (id) => document.getElementById(id);
const table = find("table"), body = table.tBodies[0], rows = [...body.rows];
const heads = [...table.tHead.rows[0].cells];
const names = new Intl.Collator(undefined, { numeric: true, sensitivity: "base" });
const words = new Map(rows.map((row) => [row, row.textContent.toLowerCase()]));
let only = null; // { filter, value }: what a button of the tables above has asked for

const text = (row, column) => row.cells[column].textContent.trim();

function sort(column, descending) {
  const numbers = heads[column].classList.contains("n");
  const compare = (a, b) => {
    const one = text(a, column), other = text(b, column);
    if (!one || !other) return (one ? 0 : 1) - (other ? 0 : 1); // empty ones stay at the end
    const order = numbers ? one - other : names.compare(one, other);
    return descending ? -order : order;
  };
  body.append(...rows.sort(compare));
  heads.forEach((head, number) => {
    if (number === column) head.setAttribute("aria-sort", descending ? "descending" : "ascending");
    else head.removeAttribute("aria-sort");
  });
}

function chosen(row) {
  if (!only) return true;
  if (only.filter === "bin") return row.dataset.bin === only.value;
  if (only.filter === "mistake") return (row.dataset.mistake || "").split(" ").includes(only.value);
  const column = heads.findIndex((head) => head.dataset.todo === only.value);
  return row.cells[column].classList.contains(only.filter === "wrong" ? "w" : "u");
}

function show() {
  const wanted = find("search").value.toLowerCase().trim(), kind = find("kind").value;
  let count = 0;
  for (const row of rows) {
    const fits = chosen(row) && words.get(row).includes(wanted) &&
      (!kind || row.dataset.kind.split(" ").includes(kind));
    row.hidden = !fits;
    count += fits;
  }
  find("count").textContent = `${count} of ${rows.length}`;
  find("filter").hidden = !only;
}

heads.forEach((head, column) => head.firstElementChild.addEventListener("click", () => {
  const first = head.classList.contains("n") ? "descending" : "ascending";
  const now = head.getAttribute("aria-sort");
  sort(column, now ? now === "ascending" : first === "descending");
}));
for (const button of document.querySelectorAll("[data-filter]")) {
  button.addEventListener("click", () => {
    only = { filter: button.dataset.filter, value: button.dataset.value };
    find("chosen").textContent = button.dataset.says;
    show();
    find("everybody").scrollIntoView();
    find("clear").focus({ preventScroll: true });
  });
}
find("clear").addEventListener("click", () => { only = null; show(); find("search").focus(); });
find("search").addEventListener("input", show);
find("kind").addEventListener("change", show);
show(); // a browser that goes back keeps what was typed

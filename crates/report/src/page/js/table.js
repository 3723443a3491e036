// A number that is a button says what it is, whatever it shows just now.
export function label(button) {
  if (button.dataset.of) button.setAttribute("aria-label", `${button.dataset.of}: ${button.textContent}${button.dataset.relative ?? ""}. Where it comes from`);
}

// Sorting, filtering and ratios of the tables. Without it the page is complete, in its first order.
export function startTables() {
  const all = (selector, root = document) => [...root.querySelectorAll(selector)];
  const number = (cell) => (cell && cell.dataset.value !== undefined ? Number(cell.dataset.value) : NaN);

  // Sort: the variants of each part of a table by one column; what was not measured goes last.
  const sortBy = (table, header, column) => {
    const down = header.getAttribute("aria-sort") === "ascending";
    all("[aria-sort]", table).forEach((th) => th.removeAttribute("aria-sort"));
    header.setAttribute("aria-sort", down ? "descending" : "ascending");
    const key = (body) => number(body.rows[0].children[column]);
    const order = (a, b) => {
      const [x, y] = [key(a), key(b)];
      if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) - Number.isNaN(y);
      return down ? y - x : x - y;
    };
    for (const kind of all("tbody.kind", table)) {
      const same = (body) => body.dataset.calibration === kind.dataset.calibration;
      kind.after(...all("tbody.variant", table).filter(same).sort(order));
    }
  };
  for (const table of all("table.scores")) {
    all("th.sortable", table).forEach((header, i) => {
      const button = document.createElement("button");
      button.type = "button";
      button.className = "sort";
      button.textContent = "↕";
      button.setAttribute("aria-label", "Sort by " + header.querySelector(".name").textContent);
      button.addEventListener("click", () => sortBy(table, header, i + 1));
      header.querySelector(".name").after(button);
    });
  }

  // Filter and relative: for the pooled table.
  const section = document.querySelector("#table");
  const controls = section.querySelector(".controls");
  const [filter, printed, relative] = [".filter", ".printed", ".relative"].map((s) => controls.querySelector(s));
  const bodies = all("tbody.variant", section);
  const show = () => {
    const wanted = filter.value.trim().toLowerCase();
    const kept = (body) => printed.checked || body.dataset.calibration !== "as printed";
    for (const body of bodies) body.hidden = !kept(body) || !body.dataset.words.toLowerCase().includes(wanted);
    for (const kind of all("tbody.kind", section)) {
      kind.hidden = bodies.every((b) => b.hidden || b.dataset.calibration !== kind.dataset.calibration);
    }
  };
  const compare = () => {
    const chosen = bodies.find((body) => body.dataset.variant === relative.value);
    const base = chosen && chosen.rows[0];
    section.querySelector(".ratio-note").hidden = !base;
    for (const cell of bodies.flatMap((body) => all("td[data-value]", body))) {
      const [value, half] = [cell.querySelector(".value"), cell.querySelector(".half")];
      value.dataset.absolute ??= value.textContent;
      const by = base ? number(base.children[cell.cellIndex]) : NaN;
      const ratio = number(cell) / by;
      value.textContent = !base ? value.dataset.absolute : by > 0 ? "× " + ratio.toPrecision(3) : "–";
      if (base) value.dataset.relative = " of " + chosen.querySelector("th strong").textContent;
      else delete value.dataset.relative;
      label(value);
      if (half) half.hidden = Boolean(base);
    }
  };
  filter.addEventListener("input", show);
  printed.addEventListener("change", show);
  relative.addEventListener("change", compare);
  controls.hidden = false;

  // What scrolls sideways can be scrolled by keyboard.
  for (const wide of all(".wide, .strip-row")) wide.tabIndex = 0;

  // The command, to the clipboard where the browser allows it.
  const copy = document.querySelector("button.copy");
  if (navigator.clipboard) {
    copy.hidden = false;
    copy.addEventListener("click", async () => {
      await navigator.clipboard.writeText(document.querySelector(".command").textContent);
      copy.textContent = "Copied";
    });
  }
}

// Where a number comes from: a small panel that a click on it opens.
import { data, has } from "./planes.js";
import { changed, chooseFrame, state } from "./state.js";
import { fillSlots, root, stage } from "./viewer.js";
import { openWindow, setMode } from "./controls.js";
import { label } from "./table.js";

// As a shell takes it.
const quoted = (word) => (/^[\w./=+,:-]+$/.test(word) ? word : "'" + word.replaceAll("'", "'\\''") + "'");

// The run's own command without its narrowing and its places, and narrowed to one thing.
export function narrowed(command, w, variant) {
  const words = command.match(/(?:[^\s'\\]|'[^']*'|\\.)+/g) ?? [];
  const taken = ["--scene", "--path", "--variant", "--out", "--cache", "--baseline", "--save-baseline", "--baselines"];
  const kept = words.filter((word, i) => !taken.includes(word.split("=")[0]) && !(taken.includes(words[i - 1])));
  // Frames from elsewhere are scored whole.
  if (words[1] !== "evaluate") return words.filter((word, i) => ![word, words[i - 1]].some((v) => ["--out", "--cache"].includes(v))).join(" ");
  // What is pooled over windows takes all of them.
  const place = w ? ["--scene", quoted(w.scene), "--path", quoted(w.path)] : words.flatMap((word, i) => (["--scene", "--path"].includes(word) ? [word, words[i + 1]] : []));
  return [...kept, ...place, "--variant", quoted(variant)].join(" ");
}

// Opens the viewer at a place: truth beside what a variant does there.
export function openAt({ window, variant, kind = "error", place, frame = null }) {
  openWindow(window);
  const id = `v${variant}-${kind}`;
  Object.assign(state, { left: `v${variant}-shadow`, right: id, box: place ?? null });
  setMode("side");
  fillSlots();
  stage.dataset.opened = "true";
  if (frame !== null) chooseFrame((frame - data.windows[window].first) / data.windows[window].step);
  root.scrollIntoView({ block: "start" });
  stage.focus({ preventScroll: true });
  if (place) requestAnimationFrame(() => zoomTo(place));
  changed();
}

function zoomTo([left, top, width, height]) {
  const half = stage.clientWidth / 2;
  state.view = { zoom: Math.min(half / (width * 1.3), stage.clientHeight / (height * 1.3)), x: left + width / 2, y: top + height / 2 };
  changed();
}

// The worst place of a score: of one window, or of the window that is worst of all.
function worst(metric, variant, window) {
  const all = data.trace.filter((t) => t.metric === metric && t.variant === variant);
  if (window !== null) return all.find((t) => t.window === window);
  const value = (t) => Number(document.querySelector(`#window-${t.window} tbody[data-variant="${variant}"] td[data-metric="${metric}"]`)?.dataset.value ?? -1);
  const off = (t) => (metric === "width_ratio" ? Math.abs(value(t) - 1) : value(t));
  return all.reduce((a, b) => (a && off(a) >= off(b) ? a : b), undefined);
}

function paragraph(panel, text, className) {
  const p = document.createElement("p");
  p.textContent = text;
  if (className) p.className = className;
  panel.append(p);
}

const COST = { name: "GPU time", definition: "Milliseconds a frame by timestamp queries: the median of many frames; the bar reaches the 95th percentile.", formula: "" };

// A row of the table is a variant; of the further scores a column is.
const variantOf = (cell) => Number(cell.dataset.variant ?? cell.closest("tbody").dataset.variant);

function fill(panel, cell) {
  const [variant, metric] = [variantOf(cell), cell.dataset.metric];
  const article = cell.closest("article.window");
  const window = article ? Number(article.id.slice("window-".length)) : null;
  const [about, of] = [metric === "cost" ? COST : data.metrics[metric], data.variants[variant]];
  panel.replaceChildren();
  const head = document.createElement("h3");
  head.textContent = `${about?.name ?? metric}, ${of.name} (${of.label})`;
  panel.append(head);
  paragraph(panel, cell.title, "exact-value");
  if (about) {
    paragraph(panel, about.definition);
    paragraph(panel, about.formula, "formula");
  }
  // Nothing is worst where nothing is wrong, and time has no place.
  const placeless = Number(cell.dataset.value) === 0 || metric === "cost";
  const place = placeless ? undefined : worst(metric, variant, window);
  const where = place?.window ?? window ?? 0;
  const w = data.windows[where];
  if (place) {
    const [x, y, width, height] = place.place;
    const frame = place.frame === null ? "" : `; frame ${place.frame} adds most`;
    paragraph(panel, `Worst in ${w.scene}, ${w.path}, in the block of 2 × 2 tiles at pixels ${x}, ${y} (${width} × ${height})${frame}.`);
  } else if (!placeless) paragraph(panel, "No worst place is stored for this score.", "muted");
  const buttons = document.createElement("p");
  const button = (text, act) => {
    const made = document.createElement("button");
    [made.type, made.textContent] = ["button", text];
    made.addEventListener("click", act);
    buttons.append(made, " ");
  };
  if (root && has(where, `v${variant}-shadow`)) {
    const moves = /moving|swimming/.test(metric) && has(where, `v${variant}-swim`);
    button("Look at it in the viewer", () => {
      panel.close();
      openAt({ window: where, variant, kind: moves ? "swim" : "error", place: place?.place, frame: place?.frame ?? null });
    });
  }
  const command = narrowed(data.command, window === null ? null : w, of.id);
  const line = document.createElement("pre");
  line.className = "command";
  line.tabIndex = 0;
  line.textContent = command;
  if (navigator.clipboard) button("Copy the command", () => navigator.clipboard.writeText(command));
  button("Close", () => panel.close());
  paragraph(panel, "Measured again by:");
  panel.append(line, buttons);
}

// Every number of a table becomes a button.
export function startTraces() {
  const panel = document.querySelector("#trace");
  let from = null;
  for (const cell of document.querySelectorAll("table.scores td[data-metric], table.further td[data-metric]")) {
    const value = cell.querySelector(".value");
    const button = document.createElement("button");
    [button.type, button.className, button.textContent] = ["button", value.className + " number", value.textContent];
    const of = data.variants[variantOf(cell)];
    button.dataset.of = `${data.metrics[cell.dataset.metric]?.name ?? "GPU time"} of ${of.name}`;
    label(button);
    value.replaceWith(button);
    button.addEventListener("click", () => {
      fill(panel, cell);
      from = button;
      panel.open || panel.showModal();
    });
  }
  panel.addEventListener("close", () => from?.focus({ preventScroll: true }));
  // Each row of pictures opens in the viewer.
  for (const row of root ? document.querySelectorAll(".variant-row[data-variant]") : []) {
    const { window, variant } = row.dataset;
    if (!has(Number(window), `v${variant}-shadow`)) continue;
    const button = document.createElement("button");
    [button.type, button.className, button.textContent] = ["button", "open", "Open in the viewer"];
    button.addEventListener("click", () => openAt({ window: Number(window), variant: Number(variant) }));
    row.querySelector("h4").append(" ", button);
  }
}

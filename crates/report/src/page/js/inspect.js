// The inspector: every layer's value at the cursor or the pinned point.
import { data, has, plane } from "./planes.js";
import { REGIONS, errorAt, shadowAt, truthAt } from "./layers.js";
import { positionOf } from "./points.js";
import { current, middle, state } from "./state.js";

const digits = (v, n = 4) => (v === undefined || v === null || Number.isNaN(v) ? "–" : v.toFixed(n));
const signed = (v, n = 4) => (v > 0 ? "+" : "") + digits(v, n).replace("-", "−");

function fact(list, name, text, value) {
  const [dt, dd] = [document.createElement("dt"), document.createElement("dd")];
  dt.textContent = name;
  dd.textContent = text;
  if (value !== undefined) [dd.dataset.layer, dd.dataset.value] = [name, String(value)];
  list.append(dt, dd);
}

function cell(row, text, layer, value) {
  const td = row.insertCell();
  td.textContent = text;
  [td.dataset.layer, td.dataset.value] = [layer, String(value)];
}

function facts(list, pixel) {
  const { width } = current();
  const at = (name) => (has(state.window, name) ? plane(state.window, name)?.[0][pixel] : undefined);
  fact(list, "pixel", `${pixel % width}, ${Math.floor(pixel / width)}`);
  const truth = truthAt(state.window, state.frame ?? middle())?.[pixel];
  const error = at("se");
  fact(list, "truth", digits(truth, 5) + (error === undefined ? "" : " ± " + digits(error, 5)), truth);
  fact(list, "region", REGIONS[at("region")] ?? "nothing is seen");
  const world = positionOf(state.window, pixel);
  if (world) fact(list, "world, m", world.map((v) => v.toFixed(3).replace("-", "−")).join(", "));
  if (at("depth") !== undefined) fact(list, "depth, m", digits(at("depth"), 3), at("depth"));
}

function rows(body, pixel) {
  data.variants.forEach((v, i) => {
    if (!has(state.window, `v${i}-shadow`)) return;
    const row = body.insertRow();
    row.dataset.variant = i;
    const head = document.createElement("th");
    head.scope = "row";
    head.className = v.class;
    head.textContent = v.label === "as printed" ? v.name + " (as printed)" : v.name;
    row.append(head);
    const shadow = shadowAt(state.window, i, state.frame)?.[pixel];
    const error = errorAt(state.window, i, state.frame)?.[pixel];
    const swim = has(state.window, `v${i}-swim`) ? plane(state.window, `v${i}-swim`)?.[0][pixel] : undefined;
    cell(row, digits(shadow), "shadow", shadow);
    cell(row, signed(error), "error", error);
    cell(row, digits(swim), "swim", swim);
  });
}

// Shows a pixel of the middle frame's points; null: nothing.
export function inspect(root, pixel) {
  const [list, body] = [root.querySelector("dl"), root.querySelector("tbody")];
  list.replaceChildren();
  body.replaceChildren();
  root.querySelector(".hint").hidden = pixel !== null;
  root.querySelector(".found").hidden = pixel === null;
  if (pixel === null) return;
  facts(list, pixel);
  rows(body, pixel);
}

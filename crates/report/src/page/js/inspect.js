// The inspector: every layer's value at the cursor or the pinned point.
import { data, has, plane } from "./planes.js";
import { REGIONS, errorOf, shadowAt, truthAt } from "./layers.js";
import { CELLS, cellKinds, hasCells, tileOf, tileScore } from "./cells.js";
import { positionOf } from "./points.js";
import { current, middle, state } from "./state.js";

const digits = (v, n = 4) => (v === undefined || v === null || Number.isNaN(v) ? "–" : v.toFixed(n).replace(/^-(0\.?0*)$/, "$1"));
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
  penumbraWidth(list, at("width"), at("region"));
}

// The true 10-90 % width on the surface, or why there is none.
function penumbraWidth(list, metres, region) {
  if (!has(state.window, "width")) return;
  const why = REGIONS[region] === "penumbra" ? "too little of an edge within 16 × 16 pixels" : "only a penumbra has a width";
  const none = metres === undefined || Number.isNaN(metres);
  fact(list, "penumbra width, m", none ? `– (${why})` : metres.toPrecision(3) + " (10 to 90 % of the truth)", metres);
}

function header(row, i, v) {
  row.dataset.variant = i;
  const head = document.createElement("th");
  head.scope = "row";
  head.className = v.class;
  head.textContent = v.label === "as printed" ? v.name + " (as printed)" : v.name;
  row.append(head);
}

// Scores of the tile that a pixel lies in: ERROR as a root, its parts in millionths.
function tile(root, pixel) {
  const there = data.variants.some((_, i) => hasCells(state.window, i));
  root.hidden = !there;
  if (!there) return;
  const place = tileOf(state.window, pixel);
  const [x, y] = [place.column * data.tile_px, place.row * data.tile_px];
  root.querySelector(".tile-name").textContent = `Tile at ${x}, ${y} (${data.tile_px} × ${data.tile_px} px)`;
  const kinds = cellKinds(state.window);
  const names = kinds.map((kind) => Object.assign(document.createElement("th"), { textContent: kind === "mse" ? "ERROR, RMSE" : CELLS[kind], scope: "col" }));
  root.querySelector("thead tr").replaceChildren(Object.assign(document.createElement("th"), { textContent: "variant", scope: "col" }), ...names);
  const body = root.querySelector("tbody");
  body.replaceChildren();
  data.variants.forEach((v, i) => {
    if (!hasCells(state.window, i)) return;
    const row = body.insertRow();
    header(row, i, v);
    for (const kind of kinds) {
      const value = tileScore(state.window, i, kind, place);
      const shown = kind === "mse" ? digits(value > 0 ? Math.sqrt(value) : value) : digits(value * 1e6, 1).replace("-", "−");
      cell(row, shown, "tile-" + kind, value);
    }
  });
  root.querySelector(".no-penumbra").hidden = !data.variants.some((_, i) => Number.isNaN(tileScore(state.window, i, "mse", place)));
}

function rows(body, pixel) {
  data.variants.forEach((v, i) => {
    if (!has(state.window, `v${i}-shadow`)) return;
    const row = body.insertRow();
    header(row, i, v);
    const shadow = shadowAt(state.window, i, state.frame)?.[pixel];
    const error = errorOf(state.window, i, state.frame, pixel);
    const swim = has(state.window, `v${i}-swim`) ? plane(state.window, `v${i}-swim`)?.[0][pixel] : undefined;
    cell(row, digits(shadow), "shadow", shadow);
    cell(row, signed(error), "error", error);
    cell(row, digits(swim), "swim", swim);
  });
}

// Shows a pixel of the middle frame's points; null: nothing. `pinned`: it is the point that is followed.
export function inspect(root, pixel, pinned) {
  const [list, body] = [root.querySelector("dl"), root.querySelector("tbody")];
  const tiles = root.parentElement.querySelector(".tile-scores");
  root.querySelector("h3").textContent = pinned ? "At the pinned point" : "At this pixel";
  list.replaceChildren();
  body.replaceChildren();
  root.querySelector(".hint").hidden = pixel !== null;
  root.querySelector(".found").hidden = pixel === null;
  tiles.hidden = true;
  if (pixel === null) return;
  facts(list, pixel);
  rows(body, pixel);
  tile(tiles, pixel);
}

// What stands on and under the stage: names, refusals, colour bars, captions.
import { regionColour } from "./colour.js";
import { captionOf, unitOf } from "./captions.js";
import { data } from "./planes.js";
import { REGIONS, labelOf, lacksFrame, variantOf } from "./layers.js";
import { state } from "./state.js";

const BARS = { shadow: "shadow", error: "error" };

const make = (name, className, ...parts) => {
  const made = document.createElement(name);
  made.className = className;
  made.append(...parts);
  return made;
};

const minus = (text) => text.replace("-", "−");
const end = (v) => minus(String(Number(v.toPrecision(3))));
const name = (id) => (id ? labelOf(id) + lacksFrame(state.window, id, state.frame) : "");

function tags(root, mode) {
  const [left, right] = [".tag.left", ".tag.right"].map((tag) => root.querySelector(tag));
  const [a, b] = { left: [state.left, null], flipped: [null, state.right] }[mode] ?? [state.left, state.right];
  if (mode === "difference") [left.textContent, right.textContent] = [`${name(b)}, minus ${name(a)}`, ""];
  else [left.textContent, right.textContent] = [name(a), name(b)];
  left.hidden = !left.textContent;
  right.hidden = !right.textContent;
  const line = root.querySelector(".split-line");
  line.hidden = mode !== "slider";
  line.style.left = 100 * state.split + "%";
}

// The bar of a kind of layer with its ends, unit and what the numbers in its pixels are.
function legend({ kind, scale, form, tiled, isDifference }) {
  if (kind === "region") {
    const category = (text, i) => {
      const swatch = make("span", "swatch-box");
      swatch.style.background = regionColour(i);
      return make("span", "category", swatch, text);
    };
    return make("span", "scale", "penumbra mask: ", ...REGIONS.map(category));
  }
  const bar = make("span", "bar " + (isDifference ? "error" : (BARS[kind] ?? "swim")));
  const numbers = form?.says ? `; numbers ${form.says}` : "";
  return make("span", "scale", end(scale.low), bar, `${end(scale.high)} ${unitOf(kind)}${tiled ? ", by tile" : ""}${numbers}`);
}

// Of frames from elsewhere, where it moves.
function caveat({ id, kind }) {
  const moves = kind === "swim" || kind === "swimming" || kind.endsWith("_moving");
  const says = moves ? data.variants[variantOf(id)]?.swim_caveat : undefined;
  return says ? ` ${says}.` : "";
}

// `drawn`: the layers on the stage.
export function says(root, mode, drawn) {
  tags(root, mode);
  const refusal = root.querySelector(".refusal");
  refusal.textContent = drawn.find((d) => d.refused)?.refused ?? "";
  refusal.hidden = !refusal.textContent;
  const shown = drawn.filter((d, i) => !d.refused && drawn.findIndex((o) => o.kind === d.kind) === i);
  root.querySelector(".legends").replaceChildren(...shown.map(legend));
  const caption = (d) => (d.isDifference ? "Difference, right minus left: blue is less, red is more, white is the same." : captionOf(d.kind, !d.tiled) + caveat(d));
  root.querySelector(".captions").replaceChildren(...shown.map((d) => make("p", "", caption(d))));
}

// The gate's thresholds: what would fail if all margins were wider or narrower.

const MOST = 12;

// Margins are wider by a factor; a case fails when it would not pass at its own margin times that. What the gate
// passed at its own margins, corrected for all comparisons, it passes at wider ones.
export const failing = (cases, factor) => cases.filter((c) => (factor < 1 || c.regressed) && (factor === 1 || c.pass_at > c.margin * factor));

export function startThresholds() {
  const root = document.querySelector("#gate .thresholds");
  if (!root) return;
  const cases = JSON.parse(document.getElementById("gate-data").textContent);
  const [slider, metric, says, list] = ["input", "select", ".says", "ul"].map((s) => root.querySelector(s));
  metric.append(...[...new Set(cases.map((c) => c.metric))].map((id) => new Option(id.replaceAll("_", " "), id)));
  const show = () => {
    const factor = 2 ** Number(slider.value);
    const chosen = cases.filter((c) => !metric.value || c.metric === metric.value);
    const bad = failing(chosen, factor).sort((a, b) => b.pass_at / b.margin - a.pass_at / a.margin);
    const times = factor === 1 ? "these margins" : `${Number(factor.toPrecision(2))} × these margins`;
    says.textContent = `With ${times}, ${bad.length} of ${chosen.length} would fail.`;
    slider.setAttribute("aria-valuetext", says.textContent);
    const item = (c) => {
      const li = document.createElement("li");
      li.textContent = `${c.place}, ${c.variant}, ${c.metric.replaceAll("_", " ")}: passes from ${(c.pass_at / c.margin).toPrecision(3)} × its margin`;
      return li;
    };
    list.replaceChildren(...bad.slice(0, MOST).map(item));
    if (bad.length > MOST) list.append(Object.assign(document.createElement("li"), { textContent: `and ${bad.length - MOST} more` }));
  };
  slider.addEventListener("input", show);
  metric.addEventListener("change", show);
  root.hidden = false;
  show();
}

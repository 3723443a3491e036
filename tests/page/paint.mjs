// How long a page takes until something, everything and the viewer is there: node paint.mjs PAGE.html
// Medians of five fresh browsers. Needs `npm i playwright-core`, and a Chromium (UMBRAGE_BROWSER).
import { createRequire } from "node:module";
import { statSync } from "node:fs";
import { resolve } from "node:path";
const { chromium } = createRequire(process.cwd() + "/")("playwright-core");
const page = resolve(process.argv[2]);
const rows = [];
for (let run = 0; run < 5; run++) {
  const browser = await chromium.launch({ executablePath: process.env.UMBRAGE_BROWSER ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
  const tab = await browser.newPage({ viewport: { width: 1400, height: 900 } });
  await tab.goto("file://" + page);
  const paint = await tab.evaluate(async () => {
    const entries = () => performance.getEntriesByName("first-contentful-paint");
    while (!entries().length) await new Promise((done) => setTimeout(done, 20));
    return [entries()[0].startTime, performance.getEntriesByType("navigation")[0].loadEventEnd];
  });
  const viewer = await tab.evaluate(async () => {
    document.documentElement.style.scrollBehavior = "auto";
    document.querySelector("#viewer").scrollIntoView();
    while (document.querySelector(".stage")?.dataset.ready !== "true") await new Promise((done) => setTimeout(done, 5));
    return performance.now();
  });
  rows.push([...paint, viewer]);
  await browser.close();
}
const median = (i) => Math.round(rows.map((r) => r[i]).sort((a, b) => a - b)[2]);
console.log(`${(statSync(page).size / 1e6).toFixed(2)} MB; first paint ${median(0)} ms, loaded ${median(1)} ms, viewer's first picture ${median(2)} ms (all from the start of navigation)`);

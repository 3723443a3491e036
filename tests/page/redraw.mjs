// How long the viewer's stage takes to be drawn again, at 1280x720: node redraw.mjs PAGE.html
// Each time is the script's work and the raster's, which reading a pixel back waits for; medians and 95th percentiles of 120.
// Needs `npm i playwright-core`, and a Chromium (UMBRAGE_BROWSER).
import { createRequire } from "node:module";
import { resolve } from "node:path";
const { chromium } = createRequire(process.cwd() + "/")("playwright-core");
const browser = await chromium.launch({ executablePath: process.env.UMBRAGE_BROWSER ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
const tab = await browser.newPage({ viewport: { width: 1360, height: 1000 } });
await tab.addInitScript(() => {
  globalThis.times = [];
  const ask = globalThis.requestAnimationFrame.bind(globalThis);
  globalThis.requestAnimationFrame = (act) => ask((now) => {
    const start = performance.now();
    act(now);
    document.querySelector(".stage canvas")?.getContext("2d").getImageData(640, 360, 1, 1);
    globalThis.times.push(performance.now() - start);
  });
});
await tab.goto("file://" + resolve(process.argv[2]));
await tab.evaluate(() => { document.documentElement.style.scrollBehavior = "auto"; document.querySelector(".stage").scrollIntoView(); });
await tab.waitForFunction(() => document.querySelector(".stage")?.dataset.ready === "true");
await tab.waitForTimeout(3000);
await tab.focus(".stage");
const box = await tab.locator(".stage canvas").boundingBox();
console.log(`stage ${box.width} x ${box.height}`);
const choose = (slot, id) => tab.selectOption("select." + slot, id);

async function measure(name, act) {
  await tab.waitForTimeout(300);
  await tab.evaluate(() => { globalThis.times.length = 0; });
  for (let i = 0; i < 120; i++) await act(i);
  const times = (await tab.evaluate(() => globalThis.times)).sort((a, b) => a - b);
  const at = (share) => times[Math.floor(share * (times.length - 1))].toFixed(1);
  console.log(`${name}: ${at(0.5)} ms, 95 % ${at(0.95)} ms (${times.length} redraws)`);
}
const point = (i) => tab.mouse.move(box.x + 300 + 5 * (i % 120), box.y + 200 + (i % 60));
async function drag(name) {
  await tab.mouse.move(box.x + 200, box.y + 300);
  await tab.mouse.down();
  await measure(name, point);
  await tab.mouse.up();
}

await choose("right", "v4-shadow");
await measure("slider, whole picture, inspector following", point);
await drag("slider, whole picture, panned");
await measure("frames, one after the other", () => tab.keyboard.press("."));
await tab.keyboard.press("m");
await measure("frames from their own cameras, first round and later ones", () => tab.keyboard.press("."));
await tab.keyboard.press("Escape");
await tab.keyboard.press("0");
const zoom = () => tab.evaluate(() => Number(document.querySelector(".stage").dataset.zoom));
// About the middle of the picture, from the whole of it.
async function zoomTo(least) {
  await tab.mouse.move(2, 2);
  await tab.keyboard.press("0");
  for (await tab.waitForTimeout(100); (await zoom()) < least; await tab.waitForTimeout(100)) await tab.keyboard.press("+");
}
for (const least of [8, 16]) {
  await choose("left", "truth");
  await choose("right", "v4-error");
  await zoomTo(least);
  await drag(`${await zoom()} times, a number in every pixel, panned`);
  await tab.keyboard.press("d");
  await choose("right", "v4-shadow");
  await zoomTo(least);
  await drag("the same, a difference");
  await tab.keyboard.press("s");
}
await browser.close();

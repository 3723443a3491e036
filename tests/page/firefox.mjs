// The page in Firefox, by WebDriver BiDi: node firefox.mjs PAGE.html [SCREENSHOT.png]
// Needs `npm i puppeteer-core`, and a Firefox (UMBRAGE_FIREFOX). Fails on an error, a warning, or a viewer that shows nothing.
import { createRequire } from "node:module";
import { resolve } from "node:path";
const puppeteer = createRequire(process.cwd() + "/")("puppeteer-core");
const [page, picture] = process.argv.slice(2);
const browser = await puppeteer.launch({ browser: "firefox", executablePath: process.env.UMBRAGE_FIREFOX ?? "/usr/bin/firefox-esr", headless: true });
const tab = await browser.newPage();
const complaints = [];
tab.on("console", (m) => ["error", "warn"].includes(m.type()) && complaints.push(m.text()));
tab.on("pageerror", (e) => complaints.push(e.message));
await tab.setViewport({ width: 1400, height: 1000 });
await tab.goto("file://" + resolve(page));
const failed = [];
const expect = (what, is) => { console.log(`${is ? "ok" : "FAILED"}: ${what}`); if (!is) failed.push(what); };
const text = (selector) => tab.$eval(selector, (e) => e.textContent);
const pause = (ms) => new Promise((done) => setTimeout(done, ms));
await tab.evaluate(() => { document.documentElement.style.scrollBehavior = "auto"; document.querySelector("#viewer").scrollIntoView(); });
await tab.waitForFunction(() => document.querySelector(".stage")?.dataset.ready === "true");
await tab.focus(".stage");
const drawn = () => tab.evaluate(() => {
  const c = document.querySelector(".stage canvas");
  const pixels = new Int32Array(c.getContext("2d").getImageData(0, 0, c.width, c.height).data.buffer);
  return { colours: new Set(pixels).size, hash: pixels.reduce((h, p) => (Math.imul(h, 31) + p) | 0, 7) };
});
const before = await drawn();
expect("the stage shows a picture", before.colours > 8);
await tab.keyboard.press("d");
await pause(400);
expect("D shows the difference", (await text(".tag.left")).includes("minus") && (await drawn()).hash !== before.hash);
await tab.keyboard.press("s");
await tab.keyboard.press("ArrowRight");
await pause(400);
expect("the inspector has every variant", (await tab.$$eval(".inspector tbody tr", (rows) => rows.length)) > 0);
expect("the tile has scores", (await tab.$$eval(".tile-scores tbody tr", (rows) => rows.length)) > 0);
if (await tab.$eval(".transport", (e) => !e.hidden)) {
  const frame = () => tab.$eval(".stage", (e) => e.dataset.frame);
  const [was] = [await frame(), await tab.keyboard.press("."), await pause(400)];
  expect("a full stop goes a frame on", (await frame()) !== was);
}
await tab.select("select.right", await tab.$eval("select.right", (s) => [...s.options].find((o) => o.value.endsWith("-noise"))?.value ?? s.value));
await pause(400);
expect("a cell is a map with its bar", (await text(".legends")).includes("root"));
await tab.keyboard.press("?");
expect("? shows the keys", await tab.$eval(".help", (e) => e.open));
await tab.keyboard.press("Escape");
await tab.$eval("#table td[data-metric=error] button", (b) => b.click());
expect("a number says where it comes from", await tab.$eval("#trace", (e) => e.open));
await tab.$eval("#trace", (e) => e.close());
expect("no complaint: " + JSON.stringify(complaints), complaints.length === 0);
await tab.evaluate(() => document.querySelector("#viewer").scrollIntoView());
await pause(500);
if (picture) await tab.screenshot({ path: picture });
console.log(await browser.version());
await browser.close();
process.exit(failed.length ? 1 : 0);

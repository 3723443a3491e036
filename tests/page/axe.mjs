// What an accessibility checker finds on a page: node axe.mjs PAGE.html [light|dark] [WIDTH]
// Needs `npm i playwright-core axe-core` in this folder or above, and a Chromium (UMBRAGE_BROWSER).
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
const require = createRequire(process.cwd() + "/");
const { chromium } = require("playwright-core");
const [page, scheme = "light", width = "1400"] = process.argv.slice(2);
const browser = await chromium.launch({ executablePath: process.env.UMBRAGE_BROWSER ?? "/usr/bin/chromium", args: ["--no-sandbox"] });
const context = await browser.newContext({ colorScheme: scheme, viewport: { width: Number(width), height: 900 }, bypassCSP: true });
const tab = await context.newPage();
await tab.goto("file://" + resolve(page));
await tab.evaluate(() => document.querySelector("#viewer").scrollIntoView());
await tab.waitForFunction(() => document.querySelector(".stage")?.dataset.ready === "true");
await tab.focus(".stage");
for (const key of ["ArrowRight", "."]) await tab.keyboard.press(key);
await tab.evaluate(readFileSync(require.resolve("axe-core/axe.min.js"), "utf8"));
const { violations } = await tab.evaluate(() => axe.run());
for (const v of violations) {
  console.log(`${v.impact}: ${v.id}: ${v.help} (${v.nodes.length})`);
  for (const node of v.nodes.slice(0, 3)) console.log("    " + node.html.slice(0, 140));
}
const serious = violations.filter((v) => ["serious", "critical"].includes(v.impact));
console.log(`${violations.length} kinds of findings, ${serious.length} of them serious`);
await browser.close();
process.exit(serious.length ? 1 : 0);

// Starts what the page has.
import { startTables } from "./table.js";
import { startControls } from "./controls.js";
import { startKeys } from "./keys.js";
import { startTraces } from "./trace.js";
import { startThresholds } from "./thresholds.js";
import { root } from "./viewer.js";

startTables();
if (root) {
  startControls();
  startKeys();
}
startTraces();
startThresholds();

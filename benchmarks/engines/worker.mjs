// The process of an engine in JavaScript: a line with what it is, then an answer for each question.
// Run with the path of an adapter; worker.py is the same for Python.

import { readFileSync } from "node:fs";
import { createInterface } from "node:readline";
import { pathToFileURL } from "node:url";

const say = (line) => process.stdout.write(JSON.stringify(line) + "\n");
const path = process.argv[2];
const adapter = await import(pathToFileURL(path));
const { about } = adapter;

let engine = null;
try {
  engine = await adapter.load();
} catch (error) {
  if (error.code !== "ERR_MODULE_NOT_FOUND") throw error;
  say({ about, missing: error.message.split("\n")[0] });
  process.exit(0);
}
const { version } = JSON.parse(
  readFileSync(new URL(`node_modules/${about.package}/package.json`, pathToFileURL(path))));
say({ about, version });

for await (const line of createInterface({ input: process.stdin })) {
  const { question, way } = JSON.parse(line);
  const start = performance.now();
  try {
    const time = adapter.answer(engine, question, way);
    say({ time, seconds: (performance.now() - start) / 1000 });
  } catch (error) {
    say({ error: String(error) });
  }
}
process.exit(0);

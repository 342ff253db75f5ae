// The package's tests in Pyodide, in Node.js: node .ci/test_in_pyodide.mjs tests/unit/search ...
// (`make test-pyodide`). What they need is in .pyodide: see .ci/fetch_pyodide.py.

import { readdirSync } from "node:fs";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("..", import.meta.url));
const { loadPyodide } = await import(`${root}.pyodide/pyodide.mjs`);

const print = (line) => console.log(line);
const python = await loadPyodide({ stdout: print, stderr: print });
for (const [place, folder] of Object.entries({ "/checkout": root, "/wheels": `${root}.pyodide/tests` })) {
  python.FS.mkdir(place);
  python.mountNodeFS(place, folder);
}
await python.loadPackage(["micropip", "numpy", "gmpy2", "click", "mypy-extensions", "librt"], { messageCallback() {} });
const wheels = readdirSync(`${root}.pyodide/tests`).filter((name) => name.endsWith(".whl"));
const install = python.pyimport("micropip").install;
await install.callKwargs(wheels.map((name) => `emfs:/wheels/${name}`), { deps: false });
python.globals.set("paths", python.toPy(process.argv.slice(2)));
process.exitCode = python.runPython(`
import os, sys
os.chdir("/checkout")
sys.path.insert(0, "/checkout")
import pytest
int(pytest.main(["-q", "-p", "no:cacheprovider", "-p", "no:faulthandler", "--tb=short", *paths]))
`);

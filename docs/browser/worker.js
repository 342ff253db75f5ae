// The worker of the page: exactpt in Pyodide, so that the page itself never waits.
//
// In: {scene, method, tiling}. Out: {loading}, a text; then {answer} and, unless that is an
// error, {picture}, what exactpt.cli.browser returns; {broken}, a text, if the worker is of no
// further use.

const tell = (loading) => postMessage({ loading });

async function load() {
  tell("Pyodide is being loaded");
  const settings = await (await fetch(new URL("settings.json", import.meta.url))).json();
  const indexURL = new URL(settings.pyodide, import.meta.url).href;
  check(indexURL, settings.integrity);
  const { loadPyodide } = await module(`${indexURL}pyodide.mjs`);
  const { default: createPyodideModule } = await module(`${indexURL}pyodide.asm.mjs`);
  const python = await loadPyodide({ indexURL, createPyodideModule });
  tell("exactpt and what it needs are being loaded");
  await python.loadPackage("micropip");
  await python.pyimport("micropip").install(new URL(settings.wheel, import.meta.url).href);
  tell("exactpt is being started");
  return python.pyimport("exactpt.cli.browser");
}

/** Let the browser refuse files of Pyodide that have not the hash in settings.json. */
function check(indexURL, hashes) {
  const fetchAny = fetch;
  self.fetch = (what, options) => {
    const address = String(what.url ?? what);
    const name = address.startsWith(indexURL) ? address.slice(indexURL.length) : "";
    if (!Object.hasOwn(hashes, name)) return fetchAny(what, options);
    const answer = fetchAny(what, { ...options, integrity: hashes[name] });
    answer.catch((error) => stop(`Pyodide or exactpt cannot be loaded: ${name}`, error)); // Pyodide may wait
    return answer;
  };
}

/** Import a module by `fetch`, which compares its hash; `import` does not. */
async function module(address) {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${address}: ${answer.status}`);
  const place = URL.createObjectURL(new Blob([await answer.text()], { type: "text/javascript" }));
  return import(place);
}

const loaded = load().catch((error) => stop("Pyodide or exactpt cannot be loaded", error));

/** Say what the worker ended by; it is of no further use. */
function stop(what, error) {
  const why = String(error.message ?? error).trim().split("\n").at(-1);
  postMessage({ broken: `${what}: ${why}` });
}

onmessage = async ({ data: { scene, method, tiling } }) => {
  const exactpt = await loaded;
  if (!exactpt) return;
  try {
    tell("the first contact is being found");
    const answer = JSON.parse(exactpt.answer(scene, method, tiling));
    postMessage({ answer });
    if (!answer.error) postMessage({ picture: JSON.parse(exactpt.picture(scene, tiling)) });
  } catch (error) {
    stop("Pyodide broke off, and starts again with the next question", error);
  }
};

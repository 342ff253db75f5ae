// The worker of the page: exactpt in Pyodide, so that the page itself never waits.
//
// In: {scene, method, tiling}. Out: {loading}, a text; then {answer} and, unless that is an
// error, {picture}, what exactpt.cli.browser returns; {broken}, a text, if the worker is of no
// further use.

const tell = (loading) => postMessage({ loading });

async function load() {
  tell("Pyodide is being loaded");
  const settings = await (await fetch("settings.json")).json();
  const { loadPyodide } = await import(new URL("pyodide.mjs", new URL(settings.pyodide, location)));
  const python = await loadPyodide();
  tell("exactpt and what it needs are being loaded");
  await python.loadPackage("micropip");
  await python.pyimport("micropip").install(new URL(settings.wheel, location).href);
  tell("exactpt is being started");
  return python.pyimport("exactpt.cli.browser");
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

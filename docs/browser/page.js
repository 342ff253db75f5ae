// The page: asks its worker, shows what comes back, and can stop it at any time.

const part = (id) => document.getElementById(id);
const [question, example, scene, method, tiling] = ["question", "example", "scene", "method", "tiling"].map(part);
const FIELDS = { scene, method, tiling };

let worker;

function start() {
  // A worker from a blob has the policy of this page; one from an address would have none.
  const code = `import ${JSON.stringify(new URL("worker.js", location).href)};`;
  const place = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
  worker = new Worker(place, { type: "module" });
  worker.onmessage = ({ data }) => {
    for (const [kind, content] of Object.entries(data)) HEARD[kind](content);
  };
  worker.onerror = (event) => HEARD.broken(event.message || "the worker could not be started");
}

function stop() {
  worker?.terminate();
  worker = undefined;
}

const HEARD = {
  loading: (text) => say(`${text} …`),
  answer({ words, json, error }) {
    if (error) return fail(error);
    part("words").textContent = words;
    part("json").textContent = json;
    offer("data", json, "application/json");
    show("words", "details");
    say("The animation is being drawn …");
  },
  picture({ page, error }) {
    if (error) return fail(error);
    show("picture");
    part("picture").srcdoc = page;
    offer("page", page, "text/html");
    finish("");
  },
  broken(text) {
    stop();
    fail(text);
  },
};

function say(text) {
  part("status").textContent = text;
}

function show(...ids) {
  for (const id of ids) part(id).hidden = false;
}

function finish(text) {
  say(text);
  part("answer").disabled = false;
  part("stop").disabled = true;
}

function fail(text) {
  finish("");
  part("error").textContent = text;
}

/** Let a link save a text as a file. */
function offer(id, text, type) {
  const link = part(id);
  URL.revokeObjectURL(link.href);
  link.href = URL.createObjectURL(new Blob([text], { type }));
  show(id);
}

/** Show nothing that is not of the scene that is asked about. */
function clear() {
  part("error").textContent = "";
  part("picture").removeAttribute("srcdoc");
  for (const id of ["words", "picture", "page", "data", "details"]) part(id).hidden = true;
}

function ask() {
  clear();
  if (!worker) start();
  part("answer").disabled = true;
  part("stop").disabled = false;
  say("Asked …");
  worker.postMessage(asked());
}

const asked = () => Object.fromEntries(Object.entries(FIELDS).map(([name, field]) => [name, field.value]));

async function choose() {
  scene.value = await (await fetch(example.value)).text();
}

/** Fill the fields from the part of the address after "#", which "Copy link" writes. */
function restore() {
  const given = new URLSearchParams(location.hash.slice(1));
  for (const [name, field] of Object.entries(FIELDS)) {
    if (given.has(name)) field.value = given.get(name);
    if (field.value === "") field.selectedIndex = 0; // no such choice
  }
  return given.has("scene");
}

question.addEventListener("submit", (event) => {
  event.preventDefault();
  if (!part("answer").disabled) ask();
});
question.addEventListener("keydown", (event) => {
  if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) question.requestSubmit();
});
part("stop").addEventListener("click", () => {
  stop();
  finish("Stopped. The next answer starts Pyodide again.");
});
part("link").addEventListener("click", async () => {
  history.replaceState(null, "", `#${new URLSearchParams(asked())}`);
  try {
    await navigator.clipboard.writeText(location.href);
    say("The link to this scene is copied.");
  } catch {
    say("The link to this scene is in the address bar.");
  }
});
example.addEventListener("change", choose);
addEventListener("hashchange", restore);
if (!restore()) await choose();

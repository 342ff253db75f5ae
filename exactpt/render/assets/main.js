// The page: all parts together, and a small interface for scripts.

const film = new Film(JSON.parse(byId("data").textContent));
const player = new Player(film);
const stage = new Stage(byId("canvas"), film, player);

let isWaiting = false;

/** Paint the picture at the next opportunity. */
function changed() {
  if (isWaiting) return;
  isWaiting = true;
  requestAnimationFrame((now) => {
    isWaiting = false;
    player.tick(now);
    const goesOn = stage.paint(now);
    controls.write();
    if (stage.hovered !== null) pointer.write();
    if (goesOn || player.isPlaying) changed();
  });
}

const panel = new Panel(film, {
  goTo: (step) => { player.goTo(step); changed(); },
  visit: () => { stage.visitContact(); changed(); },
  approach: () => { stage.replayApproach(); changed(); },
});
const controls = new Controls(film, player, stage, panel, changed);
const pointer = new Pointer(stage, byId("tip"), changed);

/** Follow the size of the window. */
function resized() {
  const isFitted = stage.camera.magnification === 1 && stage.flight === null;
  stage.painter.resize(stage.camera);
  if (isFitted) stage.fit({ isFlying: false });
  controls.drawTicks();
  stage.paint(performance.now()); // a canvas of another size is empty until it is painted
  changed();
}

stage.painter.readTheme();
stage.painter.resize(stage.camera);
stage.fit({ isFlying: false });
if (film.at !== null) player.seek(BigInt(film.at));
else if (film.end === film.start) player.goTo(film.steps.length);
new ResizeObserver(resized).observe(byId("canvas"));
changed();

/** For scripts: seek and step, and read what is shown as plain numbers. */
window.exactpt = {
  film,
  /** Show a time, "p/q". */
  seek(text) {
    player.pause();
    player.seek(fixed(text, film.timeBits));
    changed();
  },
  goTo(step) {
    player.goTo(step);
    changed();
  },
  /** Move the camera to a point ["p/q", "p/q"], with a magnification. */
  look(place, magnification) {
    Object.assign(stage, { follow: false, flight: null });
    stage.camera.place = place.map((text) => fixed(text, film.lengthBits));
    stage.camera.scale = stage.camera.fitted * magnification;
    changed();
  },
  /** Paint now, and return what is painted. */
  state() {
    stage.paint(performance.now());
    controls.write();
    const { chart, camera, painter: { pen } } = stage;
    const { edges, tiles } = film.after(player.step);
    return {
      time: film.timeText(player.time, 40),
      step: player.step,
      isPlaying: player.isPlaying,
      edges: edges.map(({ u, v, kind }) => [u, v, kind]),
      tiles: tiles.map(({ nodes }) => nodes),
      // Relative to the origin of the chart, in units of 2^lengthUnit.
      place: chart.place.map(String),
      places: Array.from(chart.x, (x, v) => [x, chart.y[v]]),
      pixels: Array.from(pen.x, (_, v) => pen.pixel(v)),
      camera: { place: camera.place.map(String), scale: camera.scale, magnification: camera.magnification },
    };
  },
  /** The part of an edge that is painted, in pixels of the canvas. */
  segment(u, v) {
    const { pen } = stage.painter;
    return pen.visible(u, v)
      .map(([x, y]) => [stage.camera.width / 2 + x, stage.camera.height / 2 - y]);
  },
  /** The names that are shown, with their places in pixels. */
  labels() {
    return stage.painter.labels();
  },
  /** The certificates of a tile that is shown, by its index in `state().tiles`, as text. */
  certificates(i) {
    return certificatesOf(film, film.after(player.step).tiles[i], player.time)
      .map(({ nodes, f, root }) => ({
        nodes, polynomial: f.map(String), root: root && film.timeText(root, 20),
      }));
  },
  /** The ends of the shadow of an edge; null if it has none. */
  shadow(u, v) {
    const edge = film.after(player.step).edges.find((e) => e.u === u && e.v === v);
    return shadowOf(edge, film.leftOf(player.step), stage.painter.pen);
  },
  /** Milliseconds per frame for painting a number of frames. */
  timing(frames) {
    const start = performance.now();
    for (let k = 0; k < frames; k += 1) {
      player.seek(film.start + ((film.end - film.start) * BigInt(k)) / BigInt(frames));
      stage.paint(performance.now());
    }
    return (performance.now() - start) / frames;
  },
};

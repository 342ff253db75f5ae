// The stage: chart, camera and painter together; the view, and flights of the camera.

const FLIGHT = 900;

class Stage {
  constructor(canvas, film, player) {
    this.film = film;
    this.player = player;
    this.canvas = canvas;
    this.chart = new Chart(film);
    this.camera = new Camera(film);
    this.painter = new Painter(canvas, film);
    const isSmall = film.bodies.length <= 12;
    this.layers = {
      tiles: true, edges: true, bridges: false, shadows: false, next: true, names: isSmall,
    };
    this.hovered = null;
    this.follow = false;
    this.flight = null;
    this.whole = this.survey();
  }

  /** The bounding box of everything during the film, relative to its origin. */
  survey() {
    const { film, chart } = this;
    let [all, largest] = [null, 0];
    for (let k = 0; k <= 64; k += 1) {
      chart.evaluate(film.start + ((film.end - film.start) * BigInt(k)) / 64n);
      const box = boxOf(chart);
      all = all === null ? box : union(all, box);
      largest = Math.max(largest, box[2] - box[0], box[3] - box[1]);
    }
    // If everything travels far together, the camera has to follow.
    this.follow = Math.max(all[2] - all[0], all[3] - all[1]) > 2.5 * largest;
    this.home = chart.place.slice();
    return all;
  }

  /** Show everything: the extent of the whole film, or the current one. */
  fit({ now = this.follow, isFlying = true } = {}) {
    const target = this.camera.framing(
      now ? this.evaluated() : { place: this.home }, now ? boxOf(this.chart) : this.whole);
    this.camera.fitted = target.scale;
    this.flyTo(target, isFlying);
  }

  /** The chart with all vertices at the current time, accurate at the current magnification. */
  evaluated() {
    const { chart, camera, player } = this;
    if (chart.isTooCoarse(player.time, camera)) chart.moveTo(player.time, camera.place);
    else chart.evaluate(player.time);
    return chart;
  }

  flyTo(target, isFlying = true) {
    const path = flight(this.camera, target);
    const isCalm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.flight = isFlying && !isCalm ? { path, start: performance.now() } : null;
    if (this.flight === null) path(1);
  }

  /** Go to the contact; if already there, magnify a thousand times. */
  visitContact() {
    const { film, player, camera, chart } = this;
    const node = film.contact?.pairs[0]?.node;
    player.goTo(film.steps.length);
    this.follow = false;
    if (node === undefined) return;
    const place = chart.placeOf(node, film.end);
    const away = place.map((c, i) => toDouble(c - camera.place[i], -BITS) * camera.scale);
    const isThere = Math.hypot(...away) < 40 && camera.magnification > 7;
    const scale = isThere ? camera.scale * 1000 : camera.fitted * 8;
    this.flyTo({ place, scale: Math.min(scale, camera.fitted * 2 ** 118) });
  }

  /** Play the last moments before the contact, for as long as they fill the view. */
  replayApproach() {
    const { film, player, camera } = this;
    const pair = film.contact?.pairs[0];
    if (!pair) return;
    player.goTo(film.steps.length);
    const size = Math.min(camera.width, camera.height) * 0.4;
    let left = film.end - film.start;
    while (left > 1n) {
      player.seek(film.end - left);
      if (this.gap(pair) < size) break;
      left /= 2n;
    }
    player.play();
    player.approach = toDouble(left, -BITS) / 4;
  }

  /** The distance in pixels of the features of a contact at the current time. */
  gap({ node, edge, other }) {
    const { camera, film } = this;
    const chart = this.evaluated();
    // Relative to the vertex, so that the difference is exact before it is rounded.
    chart.moveTo(this.player.time, chart.placeOf(node, this.player.time));
    if (other !== null) return Math.hypot(chart.x[other], chart.y[other]) * camera.scale;
    const [u, v] = edge;
    const length = Math.hypot(chart.x[v] - chart.x[u], chart.y[v] - chart.y[u]);
    return Math.abs(chart.cross(u, v) / length) * camera.scale;
  }

  /** Paint the picture of a moment; returns whether the animation continues by itself. */
  paint(now) {
    const { chart, camera, player, painter, film, layers } = this;
    if (this.flight !== null) {
      const t = Math.min((now - this.flight.start) / FLIGHT, 1);
      this.flight.path(t * t * (3 - 2 * t));
      if (t >= 1) this.flight = null;
    } else if (this.follow) {
      chart.evaluate(player.time);
      const target = camera.framing(chart, boxOf(chart));
      Object.assign(camera, { place: target.place, scale: target.scale, fitted: target.scale });
    }
    this.evaluated();
    const flash = player.flash(now);
    const isContact = film.isContact(player.step, player.time);
    painter.paint(chart, camera, {
      step: player.step,
      time: player.time,
      layers,
      hover: this.hovered,
      flash,
      pulse: isContact ? Math.min(Math.max((now - player.since) / 700, 0), 1) : 1,
    });
    return this.flight !== null || (flash !== null && !flash.isHeld)
      || (isContact && now - player.since < 700);
  }

  /** Note the item at a pixel; returns whether it has changed. */
  hover(x, y) {
    const { film, player, painter, layers } = this;
    const before = JSON.stringify(this.hovered);
    this.hovered = x === null || !painter.pen.chart ? null
      : pick(painter.pen, film, player.step, x, y, layers);
    return JSON.stringify(this.hovered) !== before;
  }

  /** The description of the hovered item. */
  words() {
    const digits = 9 + Math.max(Math.ceil(Math.log10(this.camera.magnification)), 0);
    return described(this.film, this.chart, this.hovered, this.player.time, digits);
  }
}

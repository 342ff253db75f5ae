// The painter: tiles, bodies, edges, the last changes, the next failure, the contact.

/** Opacity of the body's colour in tiles of its relative hull, by level from outside inwards. */
const LEVELS = [0.16, 0.28, 0.4];

class Painter {
  constructor(canvas, film) {
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.pen = new Pen(this.context);
    this.film = film;
    this.shown = film.bodies;
    this.colours = {};
  }

  /** Read the colours of the theme. */
  readTheme() {
    const style = getComputedStyle(document.documentElement);
    for (const name of ["paper", "ink", "soft", "outline", "diagonal", "fan", "hull", "accent",
      "contact", "added", "removed", "next", "tint0", "tint1", "tint2", "tint3", "tint4", "tint5"]) {
      this.colours[name] = style.getPropertyValue(`--${name}`).trim();
    }
  }

  /** Fit the canvas to its box on the screen. */
  resize(camera) {
    const { clientWidth, clientHeight } = this.canvas;
    const ratio = window.devicePixelRatio || 1;
    [camera.width, camera.height] = [Math.max(clientWidth, 1), Math.max(clientHeight, 1)];
    this.canvas.width = Math.round(camera.width * ratio);
    this.canvas.height = Math.round(camera.height * ratio);
    this.ratio = ratio;
  }

  /**
   * Paint the picture.
   *
   * @param view what to show: `step`, `time`, `layers`, `hover`, `flash` (edges that a step
   *   has changed, with a strength from 1 to 0), `pulse` (0 to 1, for the ring of a contact)
   */
  paint(chart, camera, view) {
    const { context, colours, film, pen } = this;
    context.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    context.fillStyle = colours.paper;
    context.fillRect(0, 0, camera.width, camera.height);
    context.lineJoin = "round";
    context.lineCap = "round";
    pen.aim(chart, camera);
    this.shown = film.present(view.time);
    const { tiles, edges } = film.after(view.step);
    if (view.layers.tiles) this.tiles(tiles.filter((tile) => !tile.inside), 1);
    this.bodies();
    if (view.layers.tiles) this.tiles(tiles.filter((tile) => tile.inside), 0.4);
    if (view.hover?.tile) this.tile(view.hover.tile);
    if (view.layers.edges) this.edges(edges);
    if (view.layers.bridges) this.bridges(edges);
    if (view.layers.shadows) this.shadows(edges, view.step);
    this.outlines();
    if (view.layers.next) this.certificate(film.steps[view.step]?.certificate ?? []);
    if (view.flash) this.flash(view.flash);
    if (view.hover) this.hover(view.hover);
    if (view.hover?.edge) this.shadows([view.hover.edge], view.step);
    if (view.layers.names) this.names();
    if (film.isContact(view.step, view.time)) this.contact(view.pulse);
  }

  stroke(colour, width, dash = []) {
    this.context.strokeStyle = colour;
    this.context.lineWidth = width;
    this.context.setLineDash(dash);
    this.context.stroke();
    this.context.setLineDash([]);
  }

  tiles(tiles, alpha) {
    const { context, colours, pen } = this;
    context.globalAlpha = alpha;
    // One path per tile: a canvas fills many small paths faster than few of many polygons.
    for (const tile of tiles) {
      context.beginPath();
      pen.polygon(tile.nodes);
      const body = this.film.bodies[tile.body];
      context.fillStyle = body ? body.colour : colours[`tint${tile.tint}`];
      context.globalAlpha = body ? LEVELS[tile.level % LEVELS.length] : alpha;
      context.fill();
    }
    context.globalAlpha = 1;
  }

  bodies() {
    const { context, pen } = this;
    for (const body of this.shown) {
      if (body.radius) this.rounded(body);
      if (body.radius || !body.closed || body.size < 3) continue;
      context.beginPath();
      for (const ring of rings(body)) pen.polygon(ring);
      context.fillStyle = body.colour;
      context.fill("evenodd");
    }
  }

  /** The core, drawn twice with a pen as wide as the body: a little wider for the outline. */
  rounded(body) {
    const { colours, context, pen } = this;
    const width = 2 * body.radius * pen.camera.scale;
    if (body.size === 1) {
      this.disc(body, width / 2);
      return;
    }
    context.beginPath();
    if (body.closed && body.size > 2) for (const ring of rings(body)) pen.polygon(ring);
    else this.around(body);
    this.stroke(colours.outline, width + 2.4);
    this.stroke(body.colour, width);
    if (body.closed && body.size > 2) {
      context.fillStyle = body.colour;
      context.fill("evenodd");
    }
  }

  /** A disc: a canvas strokes no segment of length zero. */
  disc(body, radius) {
    const { colours, context, pen } = this;
    if (!pen.isNear(body.first)) return;
    context.beginPath();
    context.arc(...pen.pixel(body.first), radius, 0, 2 * Math.PI);
    context.fillStyle = body.colour;
    context.fill();
    this.stroke(colours.outline, 1.2);
  }

  outlines() {
    const { context, colours, pen } = this;
    context.beginPath();
    for (const body of this.shown) {
      if (!body.radius && body.closed && body.size > 2) this.around(body);
    }
    this.stroke(colours.outline, 1.2);
    for (const body of this.shown) {
      if (body.radius || (body.closed && body.size > 2)) continue;
      context.beginPath();
      if (body.size > 1) this.around(body);
      this.stroke(colours.outline, 5.5);
      this.stroke(body.colour, 3.5);
      if (body.size === 1 && pen.isNear(body.first)) {
        context.beginPath();
        context.arc(...pen.pixel(body.first), 5, 0, 2 * Math.PI);
        context.fillStyle = body.colour;
        context.fill();
        this.stroke(colours.outline, 1.4);
      }
    }
  }

  around(body) {
    for (const ring of rings(body)) {
      const last = body.closed && body.size > 2 ? ring.length : ring.length - 1;
      for (let i = 0; i < last; i += 1) this.pen.segment(ring[i], ring[(i + 1) % ring.length]);
    }
  }

  edges(edges) {
    const { context, colours, pen } = this;
    for (const [kinds, colour, width, dash] of [
      [["fan"], colours.fan, 1.1, [5, 4]], [["diagonal"], colours.diagonal, 1.1, []],
      [["hull", "rim"], colours.hull, 1.8, []]]) {
      context.beginPath();
      for (const { u, v, kind } of edges) if (kinds.includes(kind)) pen.segment(u, v);
      this.stroke(colour, width, dash);
    }
  }

  /** The edges that join two bodies. */
  bridges(edges) {
    this.context.beginPath();
    for (const edge of edges) if (this.film.isBridge(edge)) this.pen.segment(edge.u, edge.v);
    this.stroke(this.colours.accent, 2.2);
  }

  /** For each edge that can be flipped, its shadow. */
  shadows(edges, step) {
    const { context, colours, film, pen } = this;
    context.beginPath();
    for (const edge of edges) {
      const found = shadowOf(edge, film.leftOf(step), pen);
      if (found) pen.segment(...found);
    }
    this.stroke(colours.soft, 1.4, [6, 4]);
  }

  /** Removed edges are dashed, added ones thick. */
  flash({ removed, added, strength }) {
    const { context, colours, pen } = this;
    context.globalAlpha = strength;
    for (const [pairs, colour, width, dash] of [
      [removed, colours.removed, 1.8, [3, 5]], [added, colours.added, 3, []]]) {
      context.beginPath();
      for (const [u, v] of pairs) pen.segment(u, v);
      this.stroke(colour, width, dash);
    }
    context.globalAlpha = 1;
  }

  /** The vertices that become collinear next: the outer two joined, all ringed. */
  certificate(nodes) {
    const { context, colours, pen } = this;
    if (!nodes.length) return;
    const [u, v] = farthest(pen, nodes);
    context.beginPath();
    if (u !== v) pen.segment(u, v);
    this.stroke(colours.next, 1.3, [2, 5]);
    context.beginPath();
    for (const node of nodes.filter((n) => pen.isNear(n))) {
      const [x, y] = pen.pixel(node);
      context.moveTo(x + 5.5, y);
      context.arc(x, y, 5.5, 0, 2 * Math.PI);
    }
    this.stroke(colours.next, 1.8);
  }

  tile({ nodes, corners }) {
    const { context, colours, pen } = this;
    context.beginPath();
    pen.polygon(nodes);
    context.globalAlpha = 0.16;
    context.fillStyle = colours.accent;
    context.fill();
    context.globalAlpha = 1;
    this.stroke(colours.accent, 1.8);
    for (const node of corners) this.dot(node, 4, colours.accent);
  }

  hover({ edge, node }) {
    if (edge) {
      this.context.beginPath();
      this.pen.segment(edge.u, edge.v);
      this.stroke(this.colours.accent, 3);
    }
    if (node !== undefined) this.dot(node, 5, this.colours.accent);
  }

  dot(node, radius, colour) {
    if (this.pen.isNear(node)) this.dotAt(...this.pen.pixel(node), radius, colour);
  }

  dotAt(x, y, radius, colour) {
    const { context } = this;
    context.beginPath();
    context.arc(x, y, radius, 0, 2 * Math.PI);
    context.fillStyle = colour;
    context.fill();
    this.stroke(this.colours.paper, 1.2);
  }

  names() {
    const { context, colours } = this;
    context.font = "12px ui-sans-serif, system-ui, sans-serif";
    context.textAlign = "center";
    context.lineWidth = 3;
    context.strokeStyle = colours.paper;
    context.fillStyle = colours.ink;
    for (const { text, x, y } of this.labels()) {
      context.strokeText(text, x, y + 4);
      context.fillText(text, x, y + 4);
    }
  }

  /** The names that fit: into their body; those of points and lines beside all other bodies. */
  labels() {
    const boxes = this.shown.map((body) => this.box(body));
    const taken = [];
    return this.shown.flatMap((body, i) => {
      const pixels = rings(body).map((ring) => ring.map((v) => this.pen.pixel(v)));
      const isThin = !body.radius && (body.size < 3 || !body.closed);
      const [x, y] = label(pixels, body.closed, isThin ? 13 : 0);
      if (Math.abs(x) > NEAR || Math.abs(y) > NEAR) return [];
      const half = this.context.measureText(body.name).width / 2;
      const place = [x - half, y - 7, x + half, y + 7];
      const fits = isThin ? !boxes.some((box, k) => k !== i && meet(box, place))
        : covers(boxes[i], place);
      if (!fits || taken.some((other) => meet(other, place))) return [];
      taken.push(place);
      return [{ text: body.name, x, y }];
    });
  }

  /** The bounding box of a body, in pixels. */
  box(body) {
    const pixels = rings(body).flat().map((v) => this.pen.pixel(v));
    const [xs, ys] = [0, 1].map((i) => pixels.map((p) => p[i]));
    const radius = body.radius * this.pen.camera.scale;
    return [Math.min(...xs) - radius, Math.min(...ys) - radius,
      Math.max(...xs) + radius, Math.max(...ys) + radius];
  }

  contact(pulse) {
    const { context, colours, film, pen } = this;
    film.contact.pairs.forEach(({ node, edge, normal, shift }) => {
      if (!pen.isNear(node)) return;
      const [dx, dy] = (shift ?? [0, 0]).map((c) => c * pen.camera.scale);
      const [x, y] = pen.pixel(node).map((c, i) => c + (i ? -dy : dx));
      context.beginPath();
      if (edge && !shift) pen.segment(...edge);
      context.globalAlpha = 0.6;
      this.stroke(colours.contact, 4);
      context.globalAlpha = 1 - pulse;
      context.beginPath();
      context.arc(x, y, 11 + 26 * pulse, 0, 2 * Math.PI);
      this.stroke(colours.contact, 2);
      context.globalAlpha = 1;
      context.beginPath();
      context.arc(x, y, 11, 0, 2 * Math.PI);
      this.stroke(colours.contact, 2.4);
      this.dotAt(x, y, 3.6, colours.contact);
      if (normal) this.arrow(x, y, normal[0], -normal[1]);
    });
  }

  arrow(x, y, dx, dy) {
    const { context } = this;
    const [tx, ty] = [x + 52 * dx, y + 52 * dy];
    context.beginPath();
    context.moveTo(x + 11 * dx, y + 11 * dy);
    context.lineTo(tx, ty);
    for (const side of [1, -1]) {
      context.moveTo(tx, ty);
      context.lineTo(tx - 9 * dx - side * 5 * dy, ty - 9 * dy + side * 5 * dx);
    }
    this.stroke(this.colours.contact, 2.4);
  }
}

/** The vertices of each ring of a body. */
function rings({ first, starts, size }) {
  return starts.map((start, k) => {
    const end = starts[k + 1] ?? size;
    return Array.from({ length: end - start }, (_, i) => first + start + i);
  });
}

function meet(a, b) {
  return a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
}

function covers(a, b) {
  return a[0] <= b[0] && a[1] <= b[1] && b[2] <= a[2] && b[3] <= a[3];
}

/** The position of a name: in the middle of a body; of a non-convex one, where it is widest. */
function label(outlines, isClosed, above) {
  const pixels = outlines.flat();
  const [x, y] = [0, 1].map((i) => pixels.reduce((sum, p) => sum + p[i], 0) / pixels.length);
  if (pixels.length < 3 || !isClosed) {
    return [x, above ? Math.min(...pixels.map((p) => p[1])) - above : y];
  }
  if (insideAt(outlines, y).some(([left, right]) => left < x && x < right)) return [x, y];
  const heights = pixels.map((p) => p[1]);
  const [low, high] = [Math.min(...heights), Math.max(...heights)];
  let [best, place] = [0, [x, y]];
  for (let k = 1; k < 16; k += 1) {
    const row = low + ((high - low) * k) / 16;
    for (const [left, right] of insideAt(outlines, row)) {
      if (right - left > best) [best, place] = [right - left, [(left + right) / 2, row]];
    }
  }
  return place;
}

/** The intervals in which a horizontal line is inside a polygon. */
function insideAt(outlines, y) {
  const crossings = outlines.flatMap((pixels) => pixels.flatMap(([px, py], i) => {
    const [qx, qy] = pixels[(i + 1) % pixels.length];
    return py <= y !== qy <= y ? [px + ((y - py) * (qx - px)) / (qy - py)] : [];
  })).sort((a, b) => a - b);
  return crossings.flatMap((left, i) => (i % 2 ? [] : [[left, crossings[i + 1]]]));
}

/** The two vertices with the largest distance. */
function farthest(pen, nodes) {
  const pairs = nodes.flatMap((u, i) => nodes.slice(i).map((v) => [u, v]));
  const length = ([u, v]) => Math.hypot(pen.x[u] - pen.x[v], pen.y[u] - pen.y[v]);
  return pairs.reduce((best, pair) => (length(pair) > length(best) ? pair : best));
}

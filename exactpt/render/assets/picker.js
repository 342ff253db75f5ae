// The picker: the item under the pointer, with its names and exact times in words.

const REACHES = { node: 11, edge: 6 };

/** The item at a pixel: a vertex, an edge of the tiling, a body or a tile; null for none. */
function pick(pen, film, step, x, y, layers) {
  const [px, py] = [x - pen.camera.width / 2, pen.camera.height / 2 - y];
  let [node, nearest] = [undefined, REACHES.node];
  const isThere = (b) => film.isThere(b, pen.chart.shown);
  for (let v = 0; v < pen.x.length; v += 1) {
    if (!isThere(film.bodies[film.nodes[v].body])) continue;
    const distance = Math.hypot(pen.x[v] - px, pen.y[v] - py);
    if (distance < nearest) [node, nearest] = [v, distance];
  }
  if (node !== undefined) return { node };
  const { edges, tiles } = film.after(step);
  if (layers.edges) {
    const found = edges
      .map((edge) => [edge, awayFrom(pen.visible(edge.u, edge.v), px, py)])
      .reduce((best, next) => (next[1] < best[1] ? next : best), [null, REACHES.edge]);
    if (found[0]) return { edge: found[0] };
  }
  const body = film.bodies.findIndex((b) => isThere(b)
    && (rings(b).filter((ring) => contains(pen.cut(ring), px, py)).length % 2
      || (b.radius && isWithin(pen, b, px, py))));
  const inside = tiles.find((tile) => (tile.inside || body < 0)
    && contains(pen.cut(tile.nodes), px, py));
  if (layers.tiles && inside) return { tile: inside };
  return body >= 0 ? { body } : null;
}

/** Whether a pixel is within the radius of a rounded body's core. */
function isWithin(pen, body, x, y) {
  const radius = body.radius * pen.camera.scale;
  return rings(body).some((ring) => ring.some((v, i) =>
    awayFrom(pen.visible(v, ring[(i + 1) % ring.length]), x, y) < radius));
}

function awayFrom(points, x, y) {
  if (points.length < 2) return Infinity;
  const [[ax, ay], [bx, by]] = points;
  const [dx, dy] = [bx - ax, by - ay];
  const k = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1);
  const t = Math.min(Math.max(k, 0), 1);
  return Math.hypot(ax + t * dx - x, ay + t * dy - y);
}

function contains(points, x, y) {
  let inside = false;
  points.forEach(([ax, ay], i) => {
    const [bx, by] = points[(i + 1) % points.length];
    if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
  });
  return inside;
}

/** Lines about the picked item; the first is its name. */
function described(film, chart, picked, time, digits) {
  if (picked.node !== undefined) {
    const [x, y] = chart.coordinates(picked.node, time, digits);
    return [film.name(picked.node), `x = ${x}`, `y = ${y}`];
  }
  if (picked.edge) {
    const { u, v, kind, from, until } = picked.edge;
    const what = { diagonal: "diagonal", hull: "diagonal on the hull", rim: "edge on the hull",
      fan: "edge of the fan" }[kind];
    return [`${what} ${film.name(u)} – ${film.name(v)}`, ...lifetime(film, from, until)];
  }
  if (picked.tile) {
    const { nodes, corners, inside, body, level, from, until } = picked.tile;
    const bends = nodes.length - corners.length;
    const what = bends ? `pseudo-triangle with ${bends} reflex vert${bends > 1 ? "ices" : "ex"}`
      : "triangle";
    return [
      inside ? `${what}, inside a body` : what,
      ...(body < 0 ? [] : [`inside the relative hull of ${film.bodies[body].name}, level ${level}`]),
      `corners ${corners.map((v) => film.name(v)).join(", ")}`,
      ...lifetime(film, from, until),
      ...proof(film, picked.tile, time),
    ];
  }
  const body = film.bodies[picked.body];
  const core = body.size === 1 ? "point" : body.size === 2 ? "segment"
    : `${body.closed ? "polygon" : "chain"} of ${body.size} vertices`;
  return [body.name, body.radius ? `${core}, rounded` : core];
}

/** The longest polynomial, in characters, that is shown. */
const LONG = 160;

/** The certificates of a tile that can fail: how many, and the one with the earliest next root. */
function proof(film, tile, time) {
  const all = certificatesOf(film, tile, time);
  if (!all.length) return ["no certificate of it can fail"];
  const [{ nodes, f, root }] = all;
  const text = polynomialText(f);
  return [
    `${all.length} certificate${all.length > 1 ? "s" : ""} can fail; first ${
      nodes.map((v) => film.name(v)).join(", ")}:`,
    text.length > LONG ? `a polynomial of degree ${f.length - 1}` : `${text} ≠ 0`,
    root === null ? "no root until a motion or the film ends"
      : `next root t ≈ ${film.timeText(root, 12)}`,
  ];
}

function lifetime(film, from, until) {
  return [
    from ? `since ${film.stepText(from)}` : "since the start",
    until === null ? "to the end" : `until ${film.stepText(until)}`,
  ];
}

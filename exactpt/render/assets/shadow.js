// Shadow edges: removing an edge between two tiles leaves a quadrangle of four concave chains;
// its shadow is the only other diagonal there, an edge of the shortest path between the corners
// that face each other across it. As in `exactpt.pseudotriangulation.flip`, but in doubles: only
// for display.

/** The ends of the shadow of an edge in the chart of the pen; null if it has none. */
function shadowOf({ u, v, kind }, leftOf, pen) {
  const [left, right] = [leftOf.get(`${u},${v}`), leftOf.get(`${v},${u}`)];
  if (kind !== "diagonal" || !left || !right || left.body >= 0 || right.body >= 0) return null;
  const turn = (a, b, c) => (pen.x[b] - pen.x[a]) * (pen.y[c] - pen.y[a])
    - (pen.y[b] - pen.y[a]) * (pen.x[c] - pen.x[a]);
  const [first, second] = [from(left, u, v), from(right, v, u)];
  // Both tiles, starting at the corner that faces the edge, counter-clockwise.
  const [start, goal] = [facing(first, turn), facing(second, turn)];
  if (start < 0 || goal < 0) return null;
  const cycle = [...first.slice(start), ...second.slice(1), ...first.slice(1, start)];
  return tangent(cycle, first.length - start - 1 + goal, turn);
}

/** The vertices of a tile from v on, around to u. */
function from({ nodes }, u, v) {
  const i = nodes.findIndex((node, k) => node === u && nodes[(k + 1) % nodes.length] === v) + 1;
  return nodes.map((_, k) => nodes[(i + k) % nodes.length]);
}

/** The index of the corner at neither end of the chain with the edge; -1 if there is none. */
function facing(nodes, turn) {
  const n = nodes.length;
  const corners = nodes.flatMap((node, k) =>
    (turn(nodes[(k + n - 1) % n], node, nodes[(k + 1) % n]) > 0 ? [k] : []));
  return corners.length === 3 ? corners[1] : -1;
}

/** The segment in the interior of the shortest path from the first vertex to that at `goal`. */
function tangent(cycle, goal, turn) {
  const n = cycle.length;
  const at = (k) => cycle[(k + 2 * n) % n];
  const isCorner = cycle.map((node, k) => turn(at(k - 1), node, at(k + 1)) > 0);
  const ends = [0, goal];
  const away = [0, 0];
  const step = (e) => {
    const [x, y] = [at(ends[e]), at(ends[1 - e])];
    const [after, before] = [at(ends[e] + 1), at(ends[e] - 1)];
    if (x === y) return 0;
    if (away[e] >= 0 && y !== after && turn(x, after, y) <= 0) return 1;
    if (away[e] <= 0 && y !== before && turn(x, y, before) <= 0) return -1;
    if (away[e] > 0 && turn(x, y, before) > 0) return -1;
    if (away[e] < 0 && turn(x, y, after) < 0) return 1;
    return 0;
  };
  for (let e = 0, stuck = 0, count = 0; stuck < 2 && count < 8 * n; count += 1) {
    const by = step(e);
    const next = (ends[e] + by + n) % n;
    if (by === 0 || (isCorner[next] && away[e] + by !== 0)) {
      stuck += 1;
      e = 1 - e;
    } else {
      [ends[e], away[e], stuck] = [next, away[e] + by, 0];
    }
  }
  return step(0) || step(1) || at(ends[0]) === at(ends[1]) ? null : [at(ends[0]), at(ends[1])];
}

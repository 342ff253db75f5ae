// Certificates of a tile: at each angle, the orientation of its vertex and its two neighbours on
// the tile. Its polynomial is computed exactly from the trajectories; so is the interval of its
// next root, by bisection with Descartes' rule of signs.

/** Bisections of the time span, after which an interval counts as one root. */
const DEPTH = 72;

/**
 * The certificates of a tile just after a time that can fail: the three nodes, the polynomial in
 * t (integers, constant term first), and the next root until one of the motions changes, or null;
 * the earliest root first.
 */
function certificatesOf(film, { nodes }, time) {
  const found = nodes.flatMap((node, i) => {
    const three = [nodes.at(i - 1), node, nodes[(i + 1) % nodes.length]];
    const f = orientation(three.map((v) => trackOf(film, v, time)));
    if (f.length < 2 || isRigid(film, three)) return [];
    return [{ nodes: three, f, root: nextRoot(film, f, time + 1n, untilOf(film, three, time)) }];
  });
  const rank = ({ root }) => (root === null ? film.end + 1n : root);
  return found.sort((a, b) => (rank(a) < rank(b) ? -1 : rank(a) > rank(b) ? 1 : 0));
}

function trackOf(film, node, time) {
  const { body, index } = film.nodes[node];
  return film.bodies[body].pieces[pieceAt(film.bodies[body], time)].rows[index];
}

/** Three vertices of one body: their certificates belong to the shape, not to the tiling. */
function isRigid(film, nodes) {
  return new Set(nodes.map((v) => film.nodes[v].body)).size === 1;
}

function untilOf(film, nodes, time) {
  return nodes.reduce((least, v) => {
    const body = film.bodies[film.nodes[v].body];
    const { until } = body.pieces[pieceAt(body, time)];
    return until !== null && until < least ? until : least;
  }, film.end);
}

/** The determinant of the rows (x, y, w), divided by the greatest common divisor of its terms. */
function orientation([a, b, c]) {
  const minor = (i, j) => difference(product(b[i], c[j]), product(b[j], c[i]));
  const f = trimmed(sum(sum(product(a[0], minor(1, 2)), product(a[1], minor(2, 0))),
    product(a[2], minor(0, 1))));
  const unit = f.reduce(gcd, 0n);
  return unit ? f.map((n) => n / unit) : f;
}

/** The first root between two fixed-point times, within 2^-DEPTH of their difference; or null. */
function nextRoot(film, f, from, until) {
  if (until <= from) return null;
  const width = until - from;
  // f(from + width s), times a power of two.
  const g = aroundTime(f, from, film.timeBits).map((n, k) => n * width ** BigInt(k));
  const share = firstRoot(g, 0);
  return share === null ? null : from + ((width * share[0]) >> BigInt(share[1]));
}

/** [k, bits]: the first root in (0, 1) is k / 2^bits, or within 2^-DEPTH of it; or null. */
function firstRoot(f, depth) {
  const changes = variations(shiftedByOne([...f].reverse()));
  if (changes === 0) return null;
  if (depth === DEPTH) return [1n, 1];
  const n = f.length - 1;
  const left = f.map((c, k) => c << BigInt(n - k));
  const low = firstRoot(left, depth + 1);
  if (low !== null) return [low[0], low[1] + 1];
  const right = shiftedByOne(left);
  if (right[0] === 0n) return [1n, 1];
  const high = firstRoot(right, depth + 1);
  return high === null ? null : [high[0] + (1n << BigInt(high[1])), high[1] + 1];
}

/** f(x + 1). */
function shiftedByOne(f) {
  const g = [...f];
  for (let i = 0; i < g.length - 1; i += 1) {
    for (let k = g.length - 2; k >= i; k -= 1) g[k] += g[k + 1];
  }
  return g;
}

function variations(f) {
  const signs = f.filter((n) => n !== 0n).map((n) => n > 0n);
  return signs.filter((sign, i) => i && sign !== signs[i - 1]).length;
}

function sum(f, g) {
  return Array.from({ length: Math.max(f.length, g.length) }, (_, k) => (f[k] ?? 0n) + (g[k] ?? 0n));
}

function difference(f, g) {
  return sum(f, g.map((n) => -n));
}

function gcd(a, b) {
  [a, b] = [a < 0n ? -a : a, b < 0n ? -b : b];
  while (b) [a, b] = [b, a % b];
  return a;
}

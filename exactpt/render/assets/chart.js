// A chart: the positions of all vertices near one time and one point, in doubles.
//
// Trajectories are expanded exactly around a time and a point before they are rounded, so that
// positions close to that point at about that time are accurate at every magnification.
// Lengths are in units of 2^lengthUnit, times in units of 2^timeUnit.

class Chart {
  constructor(film) {
    this.film = film;
    const count = film.nodes.length;
    this.x = new Float64Array(count);
    this.y = new Float64Array(count);
    this.rows = Array(count).fill(null);
    this.piece = new Int32Array(film.bodies.length);
    this.lines = new Map();
    this.bounds = [];
    this.turns = [];
    this.moveTo(film.start, film.origin);
  }

  /** Expand around a time and a point. */
  moveTo(time, [x, y]) {
    this.time = time;
    this.place = [x, y];
    this.lines.clear();
    this.bounds = [];
    this.turns = [];
    this.film.bodies.forEach((body, b) => this.enter(b, pieceAt(body, time)));
    this.evaluate(time);
  }

  /** Read the trajectories of a body in one of its pieces. */
  enter(b, piece) {
    const body = this.film.bodies[b];
    this.piece[b] = piece;
    this.lines.clear();
    for (let i = 0; i < body.size; i += 1) {
      const [x, y, w] = this.expanded(b, i);
      const bits = (power) => this.lengthShift - this.film.lengthUnit + BITS * power;
      const row = {
        x: Float64Array.from(x, (c, k) => quotient(c, w[0], bits(k))),
        y: Float64Array.from(y, (c, k) => quotient(c, w[0], bits(k))),
        w: trimmed(w).length > 1
          ? Float64Array.from(trimmed(w), (c, k) => quotient(c, w[0], BITS * k)) : null,
      };
      this.rows[body.first + i] = row;
      row.x.forEach((c, k) => raise(this.bounds, k, Math.max(Math.abs(c), Math.abs(row.y[k]))));
      row.w?.forEach((c, k) => raise(this.turns, k, Math.abs(c)));
    }
  }

  get lengthShift() {
    return Math.min(0, -this.film.lengthBits);
  }

  /** The numerators (relative to the point) and the denominator around the time, exactly. */
  expanded(b, i) {
    const { timeBits: q, lengthBits: p, bodies } = this.film;
    const track = bodies[b].pieces[this.piece[b]].rows[i];
    const size = Math.max(...track.map((f) => f.length));
    const [x, y, w] = track.map((f) =>
      aroundTime([...f, ...Array(size - f.length).fill(0n)], this.time, q));
    const [up, down] = p >= 0 ? [BigInt(p), 0n] : [0n, BigInt(-p)];
    const relative = (f, at) => f.map((c, k) => (c << up) - (at << down) * w[k]);
    return [relative(x, this.place[0]), relative(y, this.place[1]), w];
  }

  /** Evaluate the positions of all vertices at a time. */
  evaluate(time) {
    this.film.bodies.forEach((body, b) => {
      const piece = pieceAt(body, time);
      if (piece !== this.piece[b]) this.enter(b, piece);
    });
    this.shown = time;
    this.s = toDouble(time - this.time, -BITS);
    for (let v = 0; v < this.rows.length; v += 1) {
      const row = this.rows[v];
      const w = row.w === null ? 1 : horner(row.w, this.s);
      this.x[v] = horner(row.x, this.s) / w;
      this.y[v] = horner(row.y, this.s) / w;
    }
  }

  /** Whether the doubles of this chart are too coarse for a camera at a time. */
  isTooCoarse(time, camera) {
    const s = Math.abs(toDouble(time - this.time, -BITS));
    const sum = (bounds) => bounds.reduce((total, c, k) => (k ? total + c * s ** k : total), 0);
    if (sum(this.turns) > 1000) return true;
    const drift = sum(this.bounds) * camera.scale;
    if ((this.bounds[0] * camera.scale + drift) * 2 ** -46 < 1) return false;
    // Positions in view are accurate if they were less than 2^38 pixels away at the expansion.
    const [dx, dy] = camera.offset(this);
    return Math.max(drift, Math.hypot(dx, dy) * camera.scale) > 2 ** 38;
  }

  /**
   * The cross product of vertices u and v relative to the chart's point, now; exact before it is
   * rounded. Divided by their distance it is the distance of their line from the point.
   */
  cross(u, v) {
    const key = u * this.rows.length + v;
    let f = this.lines.get(key);
    if (f === undefined) {
      const [a, b] = [u, v].map((n) => {
        const { body, index } = this.film.nodes[n];
        return this.expanded(body, index);
      });
      const [left, right] = [product(a[0], b[1]), product(a[1], b[0])];
      const unit = a[2][0] * b[2][0];
      const bits = 2 * (this.lengthShift - this.film.lengthUnit);
      f = Float64Array.from(left, (c, k) => quotient(c - right[k], unit, bits + BITS * k));
      this.lines.set(key, f);
    }
    const [w, z] = [u, v].map((n) => (this.rows[n].w ? horner(this.rows[n].w, this.s) : 1));
    return horner(f, this.s) / (w * z);
  }

  /** The position of a vertex at a time, in fixed-point numbers. */
  placeOf(node, time) {
    const { body, index } = this.film.nodes[node];
    const owner = this.film.bodies[body];
    const track = owner.pieces[pieceAt(owner, time)].rows[index];
    const [x, y, w] = valuesAt(track, time, this.film.timeBits);
    const p = this.film.lengthBits;
    return [x, y].map((n) => (p >= 0 ? (n << BigInt(p)) / w : n / (w << BigInt(-p))));
  }

  /** The coordinates of a vertex at a time, in decimals. */
  coordinates(node, time, digits) {
    const { body, index } = this.film.nodes[node];
    const owner = this.film.bodies[body];
    const track = owner.pieces[pieceAt(owner, time)].rows[index];
    const [x, y, w] = valuesAt(track, time, this.film.timeBits);
    return [x, y].map((n) => decimal(n, w, 0, digits));
  }
}

function valuesAt(track, time, q) {
  const size = Math.max(...track.map((f) => f.length));
  return track.map((f) => aroundTime([...f, ...Array(size - f.length).fill(0n)], time, q)[0]);
}

function pieceAt(body, time) {
  const { pieces } = body;
  let i = 0;
  while (i + 1 < pieces.length && pieces[i].until <= time) i += 1;
  return i;
}

function horner(f, s) {
  let value = 0;
  for (let i = f.length - 1; i >= 0; i -= 1) value = value * s + f[i];
  return value;
}

function trimmed(f) {
  let n = f.length;
  while (n > 1 && f[n - 1] === 0n) n -= 1;
  return f.slice(0, n);
}

function raise(bounds, k, value) {
  bounds[k] = Math.max(bounds[k] ?? 0, value);
}

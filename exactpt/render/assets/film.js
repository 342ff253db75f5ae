// The film: bodies with exact trajectories, steps, and the lifetimes of edges and tiles.

/** Precision of fixed-point times and coordinates, in bits of the time span and of the scene. */
const BITS = 192;

class Film {
  /** @param data the output of `exactpt.render.data` */
  constructor(data) {
    Object.assign(this, data);
    this.timeBits = BITS - data.timeUnit;
    this.lengthBits = BITS - data.lengthUnit;
    this.start = BigInt(data.start);
    this.end = BigInt(data.end);
    this.origin = data.origin.map(BigInt);
    this.steps = data.steps.map((step) => ({ ...step, time: BigInt(step.time) }));
    this.bodies = data.bodies.map(readBody);
    let first = 0;
    this.nodes = [];
    this.bodies.forEach((body, b) => {
      body.first = first;
      first += body.size;
      for (let i = 0; i < body.size; i += 1) this.nodes.push({ body: b, index: i });
    });
    this.rows = this.steps.flatMap((step, i) =>
      step.changes.map((change, j) => ({ step: i + 1, order: j, change })));
    this.edges = data.edges.map(([u, v, kind, from, until]) => ({ u, v, kind, from, until }));
    this.tiles = data.tiles.map(([nodes, corners, tint, inside, body, level, from, until]) =>
      ({ nodes, corners, tint, inside, body, level, from, until }));
    this.state = { step: -1, edges: [], tiles: [] };
  }

  /** The number of steps up to a time. */
  stepAt(time) {
    let [low, high] = [0, this.steps.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.steps[middle].time <= time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** The time of a step; step 0 is the start. */
  timeOf(step) {
    return step > 0 ? this.steps[step - 1].time : this.start;
  }

  /** The edges and tiles after a number of steps. */
  after(step) {
    if (this.state.step !== step) {
      const here = (span) => span.from <= step && (span.until === null || step < span.until);
      this.state = { step, edges: this.edges.filter(here), tiles: this.tiles.filter(here) };
    }
    return this.state;
  }

  /** The free tiles after a number of steps, each by its edges "from,to" with the tile on the left. */
  leftOf(step) {
    const state = this.after(step);
    state.leftOf ??= new Map(state.tiles.filter((tile) => !tile.inside).flatMap((tile) =>
      tile.nodes.map((u, i) => [`${u},${tile.nodes[(i + 1) % tile.nodes.length]}`, tile])));
    return state.leftOf;
  }

  /** Whether a body is there at a time. */
  isThere({ since, until }, time) {
    return (since === null || since <= time) && (until === null || time < until);
  }

  /** The bodies that are there at a time. */
  present(time) {
    return this.bodies.filter((body) => this.isThere(body, time));
  }

  /** Whether an edge of the tiling, not of its fan, joins two bodies. */
  isBridge({ u, v, kind }) {
    return kind !== "rim" && kind !== "fan" && this.nodes[u].body !== this.nodes[v].body;
  }

  /** Whether the picture is that of the contact. */
  isContact(step, time) {
    return this.contact !== null && step === this.steps.length && time >= this.end;
  }

  /** "body:vertex". */
  name(node) {
    const { body, index } = this.nodes[node];
    return `${this.bodies[body].name}:${index}`;
  }

  /** A time in decimals. */
  timeText(time, digits) {
    return decimal(time, 1n, -this.timeBits, digits);
  }

  /** The time of a step in decimals; a short fraction follows. */
  stepText(step) {
    if (step === 0) return `t = ${this.startText}`;
    const { exact } = this.steps[step - 1];
    const isShort = typeof exact === "string" && exact.length <= 18;
    if (isShort && !exact.includes("/")) return `t = ${exact}`;
    const decimals = `t ≈ ${this.timeText(this.timeOf(step), 12)}`;
    return isShort ? `${decimals} (${exact})` : decimals;
  }

  /** The exact time of a step: a fraction, or the polynomial of which it is a root. */
  exactText(step) {
    if (step === 0) return this.startText;
    const { exact, degree } = this.steps[step - 1];
    if (typeof exact === "string") return exact;
    if (exact === null) return `a root of a polynomial of degree ${degree}`;
    return `a root of ${polynomialText(exact)}`;
  }
}

/** A body; `starts` has the number of the first vertex of each ring. */
function readBody([name, colour, closed, pieces, radius = 0, starts = [0], since = null,
  until = null]) {
  const tracks = pieces.map(([until, rows]) => ({
    until: until === null ? null : BigInt(until),
    rows: rows.map((row) => row.map((f) => f.map(BigInt))),
  }));
  const [from, to] = [since, until].map((time) => (time === null ? null : BigInt(time)));
  return { name, colour, closed, radius, starts, since: from, until: to,
    size: tracks[0].rows.length, pieces: tracks };
}

/** An integer polynomial, constant term first, as a formula. */
function polynomialText(coefficients) {
  const powers = "⁰¹²³⁴⁵⁶⁷⁸⁹";
  const terms = coefficients.map((text, i) => {
    const minus = String(text).startsWith("-");
    const size = minus ? String(text).slice(1) : String(text);
    const power = i > 1 ? [...String(i)].map((c) => powers[c]).join("") : "";
    const factor = size === "1" && i > 0 ? "" : size;
    return size === "0" ? null : [minus, `${factor}${factor && i ? " " : ""}${i ? `t${power}` : ""}`];
  });
  return terms.filter(Boolean).reverse()
    .map(([minus, term], i) => (i ? (minus ? " − " : " + ") : minus ? "−" : "") + term)
    .join("");
}

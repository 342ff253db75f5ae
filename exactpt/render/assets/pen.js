// The pen: shapes are clipped to a neighbourhood of the view before they are drawn, where doubles
// are accurate. At high magnification most vertices are far outside, where doubles (and the
// canvas, which uses singles) are inaccurate; the parts of their edges inside the view are then
// computed from exact cross products.

/** Half the side of the square that is drawn, and how far edges are followed; in pixels. */
const NEAR = 8192;
const REACH = 4 * NEAR;

class Pen {
  constructor(context) {
    this.context = context;
  }

  /** Look through a camera at an evaluated chart. */
  aim(chart, camera) {
    this.chart = chart;
    this.camera = camera;
    const count = chart.x.length;
    if (this.x?.length !== count) {
      this.x = new Float64Array(count);
      this.y = new Float64Array(count);
    }
    // Pixels from the centre of the view, y upwards.
    [this.dx, this.dy] = camera.offset(chart);
    let most = 0;
    for (let v = 0; v < count; v += 1) {
      this.x[v] = (chart.x[v] + this.dx) * camera.scale;
      this.y[v] = (chart.y[v] + this.dy) * camera.scale;
      most = Math.max(most, Math.abs(this.x[v]), Math.abs(this.y[v]));
    }
    this.plain = most < NEAR;
  }

  /** The position of a vertex on the canvas. */
  pixel(v) {
    return [this.camera.width / 2 + this.x[v], this.camera.height / 2 - this.y[v]];
  }

  isNear(v) {
    return Math.abs(this.x[v]) < NEAR && Math.abs(this.y[v]) < NEAR;
  }

  /** Add a polygon to the path. */
  polygon(nodes) {
    const points = this.plain ? nodes.map((v) => [this.x[v], this.y[v]]) : this.cut(nodes);
    this.trace(points);
    if (points.length) this.context.closePath();
  }

  /** Add a segment to the path. */
  segment(u, v) {
    if (this.plain) this.trace([[this.x[u], this.y[u]], [this.x[v], this.y[v]]]);
    else this.trace(this.visible(u, v));
  }

  trace(points) {
    const { context, camera } = this;
    points.forEach(([x, y], i) => {
      const [px, py] = [camera.width / 2 + x, camera.height / 2 - y];
      if (i) context.lineTo(px, py);
      else context.moveTo(px, py);
    });
  }

  /** The part of a segment near the view: two points or none. */
  visible(u, v) {
    const [ux, uy, vx, vy] = [this.x[u], this.y[u], this.x[v], this.y[v]];
    const [uIsNear, vIsNear] = [this.isNear(u), this.isNear(v)];
    const length = Math.hypot(vx - ux, vy - uy);
    if (length === 0) return uIsNear ? [[ux, uy], [vx, vy]] : [];
    const [tx, ty] = [(vx - ux) / length, (vy - uy) / length];
    if (uIsNear || vIsNear) {
      const r = Math.min(REACH, length);
      return [
        uIsNear ? [ux, uy] : [vx - r * tx, vy - r * ty],
        vIsNear ? [vx, vy] : [ux + r * tx, uy + r * ty],
      ];
    }
    // The foot of the perpendicular from the centre of the view is at (d ty, -d tx).
    const d = this.distance(u, v, length);
    if (Math.abs(d) > REACH) return [];
    const [from, to] = [Math.max(ux * tx + uy * ty, -REACH), Math.min(vx * tx + vy * ty, REACH)];
    if (from >= to) return [];
    return [from, to].map((k) => [d * ty + k * tx, k * ty - d * tx]);
  }

  /** Signed distance of the centre of the view from the line of two far vertices; left is > 0. */
  distance(u, v, length) {
    const [ux, uy, vx, vy] = [this.x[u], this.y[u], this.x[v], this.y[v]];
    const d = (ux * vy - uy * vx) / length;
    const size = Math.abs(ux) + Math.abs(uy) + Math.abs(vx) + Math.abs(vy);
    const error = size * 2 ** -48;
    if (error < 0.02 || Math.abs(d) > REACH + error) return d;
    // Exact relative to the origin of the chart, then relative to the centre of the view.
    const { scale } = this.camera;
    const cross = this.chart.cross(u, v) * scale;
    const [dx, dy] = [(vx - ux) / length, (vy - uy) / length];
    return cross * (scale / length) + (this.dx * dy - this.dy * dx) * scale;
  }

  /** A polygon clipped to the neighbourhood of the view. */
  cut(nodes) {
    let [left, right, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
    for (const v of nodes) {
      left = Math.min(left, this.x[v]);
      right = Math.max(right, this.x[v]);
      low = Math.min(low, this.y[v]);
      high = Math.max(high, this.y[v]);
    }
    if (left > NEAR || right < -NEAR || low > NEAR || high < -NEAR) return [];
    const points = [];
    nodes.forEach((u, i) => {
      const v = nodes[(i + 1) % nodes.length];
      points.push([this.x[u], this.y[u]]);
      if (this.isNear(u) && this.isNear(v)) return;
      // The rest of the edge beyond these points is outside the square.
      points.push(...this.visible(u, v));
    });
    return [[1, 0], [-1, 0], [0, 1], [0, -1]].reduce(clipped, points);
  }
}

/** The part of a polygon on the side of the square where ax + by < NEAR. */
function clipped(points, [a, b]) {
  const result = [];
  points.forEach((p, i) => {
    const q = points[(i + 1) % points.length];
    const [s, t] = [NEAR - a * p[0] - b * p[1], NEAR - a * q[0] - b * q[1]];
    if (s >= 0) result.push(p);
    if (s >= 0 !== t >= 0) {
      const k = s / (s - t);
      result.push([p[0] + k * (q[0] - p[0]), p[1] + k * (q[1] - p[1])]);
    }
  });
  return result;
}

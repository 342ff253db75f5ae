// The camera: the exact point at the centre of the picture, and the scale in pixels per unit.

/** Height in pixels of the clock above the picture. */
const CLOCK = 76;

class Camera {
  constructor(film) {
    this.place = film.origin.slice();
    this.scale = 100;
    this.width = 1;
    this.height = 1;
    this.fitted = 100;
  }

  /** The position of a chart's origin relative to the camera; in units of length, y upwards. */
  offset(chart) {
    return this.place.map((c, i) => toDouble(chart.place[i] - c, -BITS));
  }

  /** Move by pixels. */
  pan(dx, dy) {
    this.place[0] -= fromDouble(dx / this.scale, BITS);
    this.place[1] += fromDouble(dy / this.scale, BITS);
  }

  /** Zoom and keep the point at a pixel fixed. */
  zoom(factor, px, py) {
    const scale = Math.min(Math.max(this.scale * factor, this.fitted / 256), this.fitted * 2 ** 120);
    const moved = 1 / this.scale - 1 / scale;
    this.place[0] += fromDouble((px - this.width / 2) * moved, BITS);
    this.place[1] -= fromDouble((py - this.height / 2) * moved, BITS);
    this.scale = scale;
  }

  /** The camera that shows a box [left, bottom, right, top], relative to a chart's origin. */
  framing(chart, [left, bottom, right, top]) {
    const margin = Math.min(this.width, this.height) * 0.08;
    const room = (pixels, extent) => Math.max(pixels, 1) / Math.max(extent, 1e-300);
    const scale = Math.min(
      room(this.width - 2 * margin, right - left),
      room(this.height - 2 * Math.max(margin, CLOCK), top - bottom));
    return {
      place: [
        chart.place[0] + fromDouble((left + right) / 2, BITS),
        chart.place[1] + fromDouble((bottom + top) / 2, BITS),
      ],
      scale: scale > 1e200 ? Math.min(this.width, this.height) : scale,
    };
  }

  /** The magnification relative to a picture of everything. */
  get magnification() {
    return this.scale / this.fitted;
  }
}

/** The bounding box of all vertices of an evaluated chart. */
function boxOf(chart) {
  const box = [Infinity, Infinity, -Infinity, -Infinity];
  chart.x.forEach((x, v) => {
    const y = chart.y[v];
    const body = chart.film.bodies[chart.film.nodes[v].body];
    if (!chart.film.isThere(body, chart.shown)) return;
    const { radius } = body;
    box[0] = Math.min(box[0], x - radius);
    box[1] = Math.min(box[1], y - radius);
    box[2] = Math.max(box[2], x + radius);
    box[3] = Math.max(box[3], y + radius);
  });
  return box[0] <= box[2] ? box : [0, 0, 1, 1];
}

function union(a, b) {
  return [Math.min(a[0], b[0]), Math.min(a[1], b[1]), Math.max(a[2], b[2]), Math.max(a[3], b[3])];
}

/** A path of the camera to another point and scale; t runs from 0 to 1. */
function flight(camera, target) {
  const from = { place: camera.place.slice(), scale: camera.scale };
  const way = from.place.map((c, i) => toDouble(target.place[i] - c, -BITS));
  const growth = Math.log(target.scale / from.scale);
  // On the screen, the point that is shown at the larger scale moves uniformly.
  const [anchor, larger] = growth >= 0 ? [target.place, from.scale] : [from.place, target.scale];
  return (t) => {
    if (t >= 1) {
      camera.place = target.place.slice();
      camera.scale = target.scale;
      return;
    }
    camera.scale = from.scale * Math.exp(growth * t);
    const share = (growth >= 0 ? t - 1 : t) * (larger / camera.scale);
    camera.place = anchor.map((c, i) => c + fromDouble(way[i] * share, BITS));
  };
}

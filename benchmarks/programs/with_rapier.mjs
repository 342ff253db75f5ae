// Rapier: a convex polygon that is cast against another one, in single precision.

export const about = {
  name: "rapier",
  package: "@dimforge/rapier2d-compat",
  module: "@dimforge/rapier2d-compat",
  install: "npm install @dimforge/rapier2d-compat",
  asked:
    "`castShape` of two convex polygons (or segments), each about its first vertex, with targetDistance 0, maxToi the span, " +
    "stopAtPenetration true. In single precision, so only numbers that it represents are used; " +
    "a distance of 2^-20 of the largest coordinate is taken as its rounding.",
  promises: [
    [
      "If the two moving shapes collider at some point along their trajectories, this returns the " +
        "time at which the two shape collider as well as the contact information during the " +
        "impact. Returns `null` if the two shapes never collide along their paths.",
      "documentation of Shape.castShape",
    ],
  ],
  takes: { shapes: ["convex", "segment"], motion: "linear", digits: 24 },
  ways: { "": { asked: "", allows: { of_coordinates: 2 ** -20 } } },
};

export async function load() {
  const { default: rapier } = await import("@dimforge/rapier2d-compat");
  await rapier.init();
  return rapier;
}

export function answer(rapier, question) {
  const [a, b] = [question.a, question.b];
  const velocity = (body) => ({ x: body.x[1], y: body.y[1] });
  const place = ({ vertices: [[x, y]] }) => ({ x, y });
  const hit = shapeOf(rapier, a).castShape(
    place(a), 0, velocity(a), shapeOf(rapier, b), place(b), 0, velocity(b), 0, question.span, true);
  return hit === null ? null : hit.time_of_impact;
}

function shapeOf(rapier, body) {
  const [left, low] = body.vertices[0];
  const points = body.vertices.map(([x, y]) => ({ x: x - left, y: y - low }));
  if (points.length === 2) return new rapier.Segment(points[0], points[1]);
  return new rapier.ConvexPolygon(new Float32Array(points.flatMap(({ x, y }) => [x, y])), true);
}

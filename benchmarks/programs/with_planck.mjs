// Planck: Box2D 2.3 in JavaScript, so in doubles; the time of impact of two swept polygons.

export const about = {
  name: "planck",
  package: "planck",
  module: "planck",
  install: "npm install planck",
  asked:
    "`TimeOfImpact` of two polygons (or edges), each about its first vertex, with sweeps that do " +
    "not turn, tMax 1. It seeks the time at which the distance is Settings.linearSlop = 0.005, within a quarter of it; " +
    "e_overlapped is taken as a contact at the start, e_failed as a failure. Only sizes for which " +
    "Box2D is tuned are used.",
  promises: [
    [
      "Compute the upper bound on time before two shapes penetrate. Time is represented as a " +
        "fraction between [0,tMax]. This uses a swept separating axis and may miss some " +
        "intermediate, non-tunneling collisions.",
      "documentation of TimeOfImpact",
    ],
    [
      "A small length used as a collision and constraint tolerance. Usually it is chosen to be " +
        "numerically significant, but visually insignificant.",
      "documentation of Settings.linearSlop",
    ],
  ],
  takes: { shapes: ["convex", "segment"], motion: "linear", vertices: 12, least: 0.1, most: 50 },
  ways: { "": { asked: "", allows: { distance: 0.00625, of_coordinates: 2 ** -48 } } },
};

export async function load() {
  return import("planck");
}

export function answer(planck, question) {
  const [input, output] = [new planck.TOIInput(), new planck.TOIOutput()];
  input.proxyA.set(shapeOf(planck, question.a), 0);
  input.proxyB.set(shapeOf(planck, question.b), 0);
  setSweep(input.sweepA, question.a, question.span);
  setSweep(input.sweepB, question.b, question.span);
  input.tMax = 1;
  planck.TimeOfImpact(output, input);
  if (output.state === planck.TOIOutputState.e_failed) throw new Error("e_failed");
  if (output.state === planck.TOIOutputState.e_separated) return null;
  return output.t * question.span;
}

function setSweep(sweep, body, span) {
  const [x, y] = body.vertices[0];
  sweep.c0.set(x, y);
  sweep.c.set(x + body.x[1] * span, y + body.y[1] * span);
}

function shapeOf(planck, body) {
  const [left, low] = body.vertices[0];
  const points = body.vertices.map(([x, y]) => new planck.Vec2(x - left, y - low));
  if (points.length === 2) return new planck.EdgeShape(points[0], points[1]);
  return new planck.PolygonShape(points);
}

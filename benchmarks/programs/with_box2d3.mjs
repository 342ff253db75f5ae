// Box2D 3 in WebAssembly: a polygon that is cast through a world that holds the other one.

export const about = {
  name: "Box2D 3",
  package: "box2d3-wasm",
  module: "box2d3-wasm",
  install: "npm install box2d3-wasm",
  asked:
    "`b2World_CastShape` of the second body's vertices (a b2ShapeProxy of radius 0) by its way " +
    "relative to the first body, which is a static polygon (or segment) about its first vertex; the fraction " +
    "that the callback is given. The module exports no b2TimeOfImpact. It stops at a distance of " +
    "linearSlop = 0.005, within a quarter of it. In single precision, so only numbers that it " +
    "represents are used, and only sizes for which it is tuned.",
  promises: [
    [
      "Box2D has been tuned to work well with moving shapes between 0.1 and 10 meters.",
      "Box2D documentation, Units",
    ],
  ],
  takes: {
    shapes: ["convex", "segment"],
    motion: "linear",
    vertices: 8,
    digits: 24,
    least: 0.1,
    most: 50,
  },
  ways: { "": { asked: "", allows: { distance: 0.00625, of_coordinates: 2 ** -20 } } },
};

export async function load() {
  const { default: factory } = await import("box2d3-wasm");
  return factory();
}

export function answer(b2, question) {
  const [a, b, span] = [question.a, question.b, question.span];
  const world = b2.b2CreateWorld(b2.b2DefaultWorldDef());
  addStatic(b2, world, a.vertices);
  const proxy = new b2.b2ShapeProxy();
  proxy.count = b.vertices.length;
  proxy.radius = 0;
  b.vertices.forEach(([x, y], i) => proxy.setPoint(i, new b2.b2Vec2(x, y)));
  const way = new b2.b2Vec2((b.x[1] - a.x[1]) * span, (b.y[1] - a.y[1]) * span);
  let least = null;
  b2.b2World_CastShape(world, proxy, way, b2.b2DefaultQueryFilter(), ({ fraction }) => {
    least = fraction;
    return fraction;
  });
  b2.b2DestroyWorld(world);
  return least === null ? null : least * span;
}

function addStatic(b2, world, vertices) {
  const [left, low] = vertices[0];
  const definition = b2.b2DefaultBodyDef();
  definition.position = new b2.b2Vec2(left, low);
  const body = b2.b2CreateBody(world, definition);
  const points = vertices.map(([x, y]) => new b2.b2Vec2(x - left, y - low));
  if (points.length === 2) {
    const segment = new b2.b2Segment();
    [segment.point1, segment.point2] = points;
    b2.b2CreateSegmentShape(body, b2.b2DefaultShapeDef(), segment);
  } else {
    const polygon = b2.b2MakePolygon(b2.b2ComputeHull(points), 0);
    b2.b2CreatePolygonShape(body, b2.b2DefaultShapeDef(), polygon);
  }
}

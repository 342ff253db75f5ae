// The first contact of translating bodies in doubles: sweep-and-prune on one axis, then the roots
// of linear orientations in closed form. No tolerance, no error bounds: the floor of run time.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace {

struct Scene {
    const int *first;            // of body k the vertices first[k] to first[k + 1] - 1
    const unsigned char *closed; // whether the last vertex is joined to the first one
    const double *x, *y;         // vertices at time 0
    const double *vx, *vy;       // velocities of bodies
};

struct Box {
    double left, right, low, high;
    int body;
};

void vertices_on_edges(const Scene &s, int a, int b, double start, double &best) {
    const int n = s.first[b + 1] - s.first[b], edges = s.closed[b] ? n : n - 1;
    const double wx = s.vx[a] - s.vx[b], wy = s.vy[a] - s.vy[b];
    for (int e = 0; e < edges; ++e) {
        const int i = s.first[b] + e, j = s.first[b] + (e + 1) % n;
        const double ux = s.x[j] - s.x[i], uy = s.y[j] - s.y[i], c1 = ux * wy - uy * wx;
        if (c1 == 0.0) continue;
        for (int v = s.first[a]; v < s.first[a + 1]; ++v) {
            const double zx = s.x[v] - s.x[i], zy = s.y[v] - s.y[i];
            const double t = -(ux * zy - uy * zx) / c1;
            if (!(t >= start && t < best)) continue;
            const double along = (zx + wx * t) * ux + (zy + wy * t) * uy;
            if (along >= 0.0 && along <= ux * ux + uy * uy) best = t;
        }
    }
}

} // namespace

// Returns the time of the first contact; infinity if there is none in [start, end].
extern "C" double first_contact(int bodies, const int *first, const unsigned char *closed,
                                const double *x, const double *y, const double *vx,
                                const double *vy, double start, double end) {
    const Scene s{first, closed, x, y, vx, vy};
    std::vector<Box> boxes;
    for (int k = 0; k < bodies; ++k) {
        const auto xs = std::minmax_element(x + first[k], x + first[k + 1]);
        const auto ys = std::minmax_element(y + first[k], y + first[k + 1]);
        const auto dx = std::minmax({vx[k] * start, vx[k] * end});
        const auto dy = std::minmax({vy[k] * start, vy[k] * end});
        boxes.push_back({*xs.first + dx.first, *xs.second + dx.second, *ys.first + dy.first,
                         *ys.second + dy.second, k});
    }
    std::sort(boxes.begin(), boxes.end(),
              [](const Box &a, const Box &b) { return a.left < b.left; });
    const double none = std::numeric_limits<double>::infinity();
    double best = std::nextafter(end, none);
    for (auto a = boxes.begin(); a != boxes.end(); ++a)
        for (auto b = a + 1; b != boxes.end() && b->left <= a->right; ++b) {
            if (b->low > a->high || a->low > b->high) continue;
            vertices_on_edges(s, a->body, b->body, start, best);
            vertices_on_edges(s, b->body, a->body, start, best);
        }
    return best <= end ? best : none;
}

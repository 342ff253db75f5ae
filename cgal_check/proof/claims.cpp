// Times and contacts as they are written.
#include "checker.hpp"
#include "faults.hpp"
#include "simple.hpp"

namespace proof {

namespace {

// The piece of a body's motion that holds throughout an interval.
std::size_t piece_in(const Body& body, const Rational& low, const Rational& high) {
  const std::size_t i = Scene::piece(body, Time(low));
  if (i < body.breaks.size() && body.breaks[i] < high)
    throw Rejected("the motion of " + body.name + " changes in the interval of the time");
  return i;
}

}  // namespace

Poly<Integer> Checker::polynomial_of(const TimeText& text) const {
  Poly<Integer> f = text.coefficients;
  trim(f);
  if (text.vertices.empty()) return primitive(f);
  check_vertices(text.vertices);
  std::vector<const Path*> paths;
  for (const int v : text.vertices)
    paths.push_back(&scene_.path(v, piece_in(scene_.body(v), text.low, text.high)));
  return primitive(paths.size() == 3 ? orientation(*paths[0], *paths[1], *paths[2])
                                     : paths[1]->x * paths[0]->w - paths[0]->x * paths[1]->w);
}

Time Checker::time_of(const TimeText& text) const {
  if (text.low > text.high) throw Rejected("the interval of the time is reversed");
  const Poly<Integer> f = polynomial_of(text);
  if (text.vertices.empty() && text.coefficients.empty() && text.low == text.high)
    return Time(text.low);
  if (f.empty()) throw Rejected("the polynomial of the time is zero, or missing");
  const std::optional<Time> time = Time::root(f, text.low, text.high);
  if (!time)
    throw Rejected("the polynomial of the time has not exactly one root in the interval, by "
                   "Descartes' rule");
  return *time;
}

void Checker::check_contact(const ContactText& contact, const Time& t) {
  using Kind = ContactText::Kind;
  const auto& [a, b] = contact.edge;
  if (contact.kind == Kind::inside || contact.kind == Kind::crossing)
    throw Rejected("a contact of this kind is at the start alone");
  check_vertices({contact.vertex, a});
  if (contact.kind == Kind::vertex) {
    if (contact.vertex == a) throw Rejected("a contact of a vertex with itself");
    if (!predicates_.coincide(contact.vertex, a, t)) throw Rejected("there is no contact");
    return;
  }
  check_vertices({b});
  if (!scene_.is_body_edge(a, b) || contact.vertex == a || contact.vertex == b)
    throw Rejected("a contact with something that is no edge of a body, or with an end");
  if (!predicates_.is_on(contact.vertex, a, b, t)) throw Rejected("there is no contact");
}

void Checker::check_contact_at_start(const ContactText& contact) {
  using Kind = ContactText::Kind;
  const Time given = time_of(contact.time);
  const auto& [c, d] = contact.edge;
  if (given.compare(scene_.start()) != 0) throw Rejected("there is no map");
  const Time t(scene_.start());  // the interval of a root has other ends
  if (contact.kind == Kind::edge || contact.kind == Kind::vertex) return check_contact(contact, t);
  const auto at = [&](int v) { return place(scene_.path(v, t), t.low()); };
  check_vertices({contact.vertex});
  if (contact.kind == Kind::inside) {
    const auto body = static_cast<std::size_t>(c);
    if (body >= scene_.bodies().size() || !scene_.bodies()[body].is_polygon ||
        scene_.body_of(contact.vertex) == c)
      throw Rejected("a contact with something that has no inside, or with its own vertex");
    // On an edge, or in an odd number of rings: none is around another one of its kind.
    int around = 0;
    for (const Polygon& polygon : polygons(scene_.bodies()[body], t.low())) {
      if (is_on_boundary(polygon, at(contact.vertex))) return;
      around += is_in(polygon, at(contact.vertex));
    }
    if (around % 2 == 0) throw Rejected("there is no contact");
    return;
  }
  check_vertices({contact.end, c, d});
  if (!scene_.is_body_edge(contact.vertex, contact.end) || !scene_.is_body_edge(c, d) ||
      scene_.body_of(contact.vertex) == scene_.body_of(c))
    throw Rejected("a contact of edges that are not of two bodies");
  if (!do_meet(at(contact.vertex), at(contact.end), at(c), at(d)))
    throw Rejected("there is no contact");
}

}  // namespace proof

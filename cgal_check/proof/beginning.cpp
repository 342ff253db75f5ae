// The map at the start.
#include <algorithm>
#include <set>

#include "checker.hpp"
#include "faults.hpp"

namespace proof {

void Checker::begin() {
  line_ = fresh_line_ = text_.faces.empty() ? text_.last_line : text_.faces.front().line;
  const auto count = static_cast<std::size_t>(scene_.size());
  if (count <= 1) {
    // Without an edge: no face of no vertex, and a single one of one vertex.
    if (text_.faces.size() != count || (count == 1 && text_.faces[0].vertices != std::vector{0}))
      throw Rejected("the faces are not those of this scene");
    return;
  }
  for (const FaceText& face : text_.faces) {
    line_ = face.line;
    check_vertices(face.vertices);
  }
  if (text_.faces.empty()) throw Rejected("there is no map");
  const std::vector<FaceText> solid = solid_faces();
  std::vector<FaceText> faces = text_.faces;
  faces.insert(faces.end(), solid.begin(), solid.end());
  map_.emplace(scene_.size(), faces);
  check_body_edges();
  check_components();
  if (count + faces.size() != map_->edges() + 2 * components_)
    throw Rejected("V - E + F is not " + std::to_string(2 * components_));
  begin_angles(solid);
  check_insides(fresh_);
}

// Each component is in a hole of its own of a rigid body, but for the outermost one.
void Checker::check_components() {
  component_ = map_->components();
  std::set<int> all(component_.begin(), component_.end()), inner;
  std::size_t holes = 0;
  for (const Body& body : scene_.bodies()) {
    for (const Ring& ring : body.rings) {
      if (!body.is_rigid || !ring.is_hole) continue;
      inner.insert(component(ring.first));
      ++holes;
    }
  }
  if (inner.size() != holes || all.size() != holes + 1)
    throw Rejected("the map is not connected: a component is not alone in a hole");
  components_ = all.size();
  for (const int c : all)
    if (inner.count(c) == 0) outermost_ = c;
}

// The insides of rigid polygons, a cycle for each ring.
std::vector<FaceText> Checker::solid_faces() const {
  std::vector<FaceText> result;
  for (const Body& body : scene_.bodies()) {
    if (!body.is_polygon || !body.is_rigid) continue;
    for (const Ring& ring : body.rings) {
      FaceText face{line_, {}};
      for (int i = 0; i < ring.size; ++i) face.vertices.push_back(ring.first + i);
      if (!ring.has_body_on_left) std::reverse(face.vertices.begin(), face.vertices.end());
      result.push_back(std::move(face));
    }
  }
  return result;
}

void Checker::check_body_edges() const {
  for (const Body& body : scene_.bodies())
    for (int i = 0; i < body.edges(); ++i)
      if (map_->find(body.first + i, body.next(body.first + i)) == -1)
        throw Rejected("an edge of the body " + body.name + " is not there");
}

void Checker::begin_angles(const std::vector<FaceText>& solid) {
  angles_.resize(static_cast<std::size_t>(map_->halves()));
  face_.resize(angles_.size(), -1);
  std::vector<int> all;
  for (int h = 0; h < map_->halves(); ++h) all.push_back(h);
  renew_faces({}, all);
  for (const FaceText& face : solid) {
    for (std::size_t i = 0; i < face.vertices.size(); ++i) {
      const int h = map_->find(face.vertices[i], face.vertices[(i + 1) % face.vertices.size()]);
      angle(h) = {true, true, map_->counter_clockwise(h), &times_.front(), Kind::convex};
      angle(h).kind = kind_of(h, times_.front());
    }
  }
  for (const int h : all)
    if (!angle(h).is_alive) begin_life(h);
}

}  // namespace proof

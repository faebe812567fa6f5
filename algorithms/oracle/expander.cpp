// The integer EPA of expander.h.
#include "algorithms/oracle/expander.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone::oracle {
namespace {

constexpr std::uint32_t no_face = std::numeric_limits<std::uint32_t>::max();
// Error bound of a face's distance from the origin: 2^-52 from its normal and two coordinate errors
// from its vertex.
constexpr double distance_error = 0x1p-43;
// Curved cores: the search ends when the bounds are this close, in the pair's unit.
constexpr double curved_width = 0x1p-40;
constexpr int curved_expansions = 600;

constexpr std::size_t next(std::size_t i) { return i == 2 ? 0 : i + 1; }

}  // namespace

bool Expander::add_if_outside(ExactSimplex& simplex, const IntegerVector& direction) {
  const DifferencePoint point = pair_->exact_support(make_direction(direction), filters_.support);
  const IntegerVector at = pair_->exact(point);
  const auto& p = simplex.at;
  bool outside = false;
  if (simplex.size == 1) outside = !is_zero(at - p[0]);
  if (simplex.size == 2) outside = !is_zero(cross(p[1] - p[0], at - p[0]));
  if (simplex.size == 3) {
    outside = !dot(cross(p[1] - p[0], p[2] - p[0]), at - p[0]).is_zero();
  }
  if (outside) simplex.add(*pair_, point);
  return outside;
}

// Grows the simplex to a tetrahedron. Each round searches along directions perpendicular to the
// simplex. If the difference has no extent along all of them, it lies in the simplex's affine hull.
bool Expander::grow(ExactSimplex& simplex) {
  while (simplex.size < 4) {
    std::vector<IntegerVector> directions;
    const auto& p = simplex.at;
    if (simplex.size == 1) {
      directions = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    } else if (simplex.size == 2) {
      const IntegerVector edge = p[1] - p[0];
      int axis = 0;
      for (int k = 1; k < 3; ++k) {
        if (abs(edge[k]) < abs(edge[axis])) axis = k;
      }
      IntegerVector unit = {0, 0, 0};
      unit[axis] = 1;
      const IntegerVector first = cross(edge, unit);
      directions = {first, cross(edge, first)};
    } else {
      directions = {cross(p[1] - p[0], p[2] - p[0])};
    }
    bool grown = false;
    for (const IntegerVector& direction : directions) {
      grown = add_if_outside(simplex, direction) || add_if_outside(simplex, -direction);
      if (grown) break;
    }
    if (!grown) {
      least_ = make_direction(directions[0]);
      return false;
    }
  }
  return true;
}

std::uint32_t Expander::add_point(const DifferencePoint& point) {
  points_.push_back(point);
  at_.push_back(pair_->exact(point));
  rounded_.push_back(pair_->rounded(point));
  return static_cast<std::uint32_t>(points_.size() - 1);
}

std::uint32_t Expander::add_face(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  Face face;
  face.vertices = {a, b, c};
  face.plane = make_direction(cross(at_[b] - at_[a], at_[c] - at_[a]));
  face.offset = dot(face.plane.exact, at_[a]);
  face.rounded_offset = face.plane.rounded.dot(rounded_[a]);
  face.distance = face.rounded_offset / face.plane.rounded.norm();
  faces_.push_back(std::move(face));
  return static_cast<std::uint32_t>(faces_.size() - 1);
}

bool Expander::start(const ExactSimplex& simplex) {
  ExactSimplex tetrahedron = simplex;
  points_.clear();
  at_.clear();
  rounded_.clear();
  faces_.clear();
  search_ = 0;
  least_reach_ = std::numeric_limits<double>::infinity();
  if (!grow(tetrahedron)) return false;
  const auto& p = tetrahedron.at;
  const bool turned =
      dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) > 0;  // 3 is outside of 0 1 2
  if (turned) {
    std::swap(tetrahedron.points[0], tetrahedron.points[1]);
  }
  for (int i = 0; i < 4; ++i) add_point(tetrahedron.points[i]);
  add_face(0, 1, 2);
  add_face(0, 3, 1);
  add_face(1, 3, 2);
  add_face(2, 3, 0);
  for (std::uint32_t f = 0; f < 4; ++f) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t tail = faces_[f].vertices[i], head = faces_[f].vertices[next(i)];
      for (std::uint32_t g = 0; g < 4; ++g) {
        for (std::size_t j = 0; j < 3; ++j) {
          if (faces_[g].vertices[j] == head && faces_[g].vertices[next(j)] == tail) {
            faces_[f].neighbours[i] = g;
          }
        }
      }
    }
  }
  return true;
}

bool Expander::sees(std::uint32_t point, const Face& face) const {
  const double height = face.plane.rounded.dot(rounded_[point]) - face.rounded_offset;
  const double bound = filters_.visibility * 4 * GridCore::dot_error;
  if (height > bound) return true;
  if (height < -bound) return false;
  return dot(face.plane.exact, at_[point]) > face.offset;
}

// Replaces the faces that the point sees by faces between the point and their horizon.
void Expander::replace_visible(std::uint32_t first, std::uint32_t point) {
  ++search_;
  visible_ = {first};
  faces_[first].seen = search_;
  faces_[first].visible = true;
  for (std::size_t i = 0; i < visible_.size(); ++i) {
    for (const std::uint32_t neighbour : faces_[visible_[i]].neighbours) {
      Face& face = faces_[neighbour];
      if (face.seen == search_) continue;
      face.seen = search_;
      face.visible = sees(point, face);
      if (face.visible) visible_.push_back(neighbour);
    }
  }
  made_of_.assign(points_.size(), no_face);  // vertex -> new face whose edge starts there
  const auto first_made = static_cast<std::uint32_t>(faces_.size());
  for (const std::uint32_t gone : visible_) {
    faces_[gone].alive = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t beyond = faces_[gone].neighbours[i];
      if (faces_[beyond].visible && faces_[beyond].seen == search_) continue;
      const std::uint32_t tail = faces_[gone].vertices[i], head = faces_[gone].vertices[next(i)];
      const std::uint32_t made = add_face(tail, head, point);
      faces_[made].neighbours[0] = beyond;
      made_of_[tail] = made;
      for (std::size_t j = 0; j < 3; ++j) {
        if (faces_[beyond].vertices[j] == head) faces_[beyond].neighbours[j] = made;
      }
    }
  }
  for (std::uint32_t made = first_made; made < faces_.size(); ++made) {
    const std::uint32_t after = made_of_[faces_[made].vertices[1]];
    faces_[made].neighbours[1] = after;
    faces_[after].neighbours[2] = made;
  }
}

// Compares offset_x / |x| < offset_y / |y|. Offsets are not negative.
bool Expander::nearer(const Face& x, const Face& y) const {
  const double bound = 2 * filters_.nearest * distance_error;
  if (x.distance < y.distance - bound) return true;
  if (x.distance > y.distance + bound) return false;
  return x.offset * x.offset * dot(y.plane.exact, y.plane.exact) <
         y.offset * y.offset * dot(x.plane.exact, x.plane.exact);
}

// Returns the face to expand: about the nearest one; for a verdict, only one that contains the
// origin.
std::uint32_t Expander::next_face(ExpansionGoal goal) const {
  std::uint32_t best = no_face;
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    if (!face.alive || face.final) continue;
    if (goal == ExpansionGoal::verdict && !face.offset.is_zero()) continue;
    if (best == no_face || face.distance < faces_[best].distance) best = f;
  }
  return best;
}

void Expander::find_nearest() {
  inside_ = true;
  nearest_ = no_face;
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    const Face& face = faces_[f];
    if (!face.alive) continue;
    inside_ = inside_ && !face.offset.is_zero();
    // A final face is better than others at the same distance.
    const bool better = nearest_ == no_face || nearer(face, faces_[nearest_]) ||
                        (face.final && !faces_[nearest_].final && !nearer(faces_[nearest_], face));
    if (better) nearest_ = f;
  }
}

void Expander::note_reach(const Face& face, const Integer& along) {
  const double reach = pair_->rounded_length(along, face.plane.exact);
  if (!(reach < least_reach_)) return;
  least_reach_ = reach;
  least_ = face.plane;
}

void Expander::expand(GridPair& pair, const ExactSimplex& simplex, ExpansionGoal goal) {
  pair_ = &pair;
  inside_ = false;
  has_volume_ = start(simplex);
  if (!has_volume_) return;
  const bool curved = pair.is_curved();
  double best_final = std::numeric_limits<double>::infinity();
  for (int expansions = 0;; ++expansions) {
    const std::uint32_t f = next_face(goal);
    if (f == no_face) break;
    const double bound = filters_.nearest * distance_error;
    if (curved && expansions == curved_expansions) break;
    if (goal == ExpansionGoal::depth) {
      if (faces_[f].distance > best_final + 2 * bound) break;
      if (curved && least_reach_ - faces_[f].distance < curved_width) break;
    }
    const DifferencePoint point = pair.exact_support(faces_[f].plane, filters_.support);
    const Integer along = dot(faces_[f].plane.exact, pair.exact(point));
    if (curved) note_reach(faces_[f], along);
    const Integer progress = along - faces_[f].offset;
    if (progress <= 0 ||
        (curved && pair.rounded_length(progress, faces_[f].plane.exact) < pair.curved_rounding)) {
      faces_[f].final = true;
      best_final = std::min(best_final, faces_[f].distance);
      if (goal == ExpansionGoal::verdict) break;  // the origin is on the surface
      continue;
    }
    replace_visible(f, add_point(point));
  }
  find_nearest();
  if (!curved) least_ = faces_[nearest_].plane;
}

Certificate::Surface Expander::surface() const {
  Certificate::Surface surface;
  std::vector<std::uint32_t> number(points_.size(), no_face);
  for (const Face& face : faces_) {
    if (!face.alive) continue;
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& n = number[face.vertices[i]];
      if (n == no_face) {
        n = static_cast<std::uint32_t>(surface.points.size());
        surface.points.push_back(points_[face.vertices[i]]);
      }
      triangle[i] = n;
    }
    surface.triangles.push_back(triangle);
  }
  return surface;
}

}  // namespace touchstone::oracle

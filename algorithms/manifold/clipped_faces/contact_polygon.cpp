// Part of clipped-faces: projection along the normal, and Sutherland-Hodgman clipping.
#include "algorithms/manifold/clipped_faces/contact_polygon.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace touchstone {
namespace {

// Numbers of the edges of a, of the edges of b, and of the line where the bodies part.
constexpr std::uint16_t first_of_a = 1, first_of_b = 0x4000, parting = 0x8000;

// Twice the signed area, positive if anticlockwise.
template <class Points>
auto doubled_area(const Points& points) {
  auto sum = points[0].x * 0;
  for (std::size_t k = 2; k < points.size(); ++k) {
    sum += (points[k - 1].x - points[0].x) * (points[k].y - points[0].y) -
           (points[k].x - points[0].x) * (points[k - 1].y - points[0].y);
  }
  return sum;
}

}  // namespace

template <class Scalar>
void ContactPolygon<Scalar>::see(const ContactFeature<Scalar>& feature, std::uint16_t first,
                                 std::vector<Seen>& seen) const {
  seen.resize(feature.points.size());
  for (std::size_t k = 0; k < seen.size(); ++k) {
    seen[k] = frame_.see(feature.points[k]);
    seen[k].edge = first++;
  }
}

template <class Scalar>
auto ContactPolygon<Scalar>::height_of(const ContactFeature<Scalar>& feature,
                                       const std::vector<Seen>& seen) const -> Line {
  Scalar a = 0, b = 0;
  if (seen.size() > 2) {
    const Scalar along = feature.normal.dot(frame_.normal);
    a = -feature.normal.dot(frame_.u) / along;
    b = -feature.normal.dot(frame_.v) / along;
  } else {
    const Scalar x = seen[1].x - seen[0].x, y = seen[1].y - seen[0].y;
    const Scalar slope = (seen[1].height - seen[0].height) / (x * x + y * y);
    a = slope * x;
    b = slope * y;
  }
  return {a, b, seen[0].height - a * seen[0].x - b * seen[0].y};
}

template <class Scalar>
template <class Value>
void ContactPolygon<Scalar>::cut(const Value& value, std::uint16_t edge, Scalar rounding) {
  // Most lines cut nothing off.
  Scalar least = rounding;
  for (const Seen& s : subject_) least = std::min(least, value(s));
  if (least >= -rounding) return;
  cut_.resize(2 * subject_.size());
  std::size_t count = 0;
  const auto side = [&](Scalar x) { return x > rounding ? 1 : x < -rounding ? -1 : 0; };
  Scalar here = value(subject_.front());
  for (std::size_t k = 0; k < subject_.size(); ++k) {
    const Seen& from = subject_[k];
    const Seen& to = subject_[k + 1 < subject_.size() ? k + 1 : 0];
    const Scalar there = value(to);
    const int side_from = side(here), side_to = side(there);
    if (side_from >= 0) {
      cut_[count] = from;
      if (side_from == 0 && side_to < 0) cut_[count].edge = edge;
      ++count;
    }
    if (side_from * side_to < 0) {
      const Scalar part = here / (here - there);
      cut_[count++] = {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y),
                       from.height + part * (to.height - from.height),
                       side_to < 0 ? edge : from.edge};
    }
    here = there;
  }
  cut_.resize(count);
  std::swap(subject_, cut_);
}

template <class Scalar>
void ContactPolygon<Scalar>::cut_by_polygon(Scalar rounding) {
  const Scalar turn = doubled_area(outline_) < 0 ? Scalar{-1} : Scalar{1};
  for (std::size_t k = 0; k < outline_.size() && !subject_.empty(); ++k) {
    const Seen& from = outline_[k];
    const Seen& to = outline_[k + 1 < outline_.size() ? k + 1 : 0];
    const Scalar x = to.x - from.x, y = to.y - from.y;
    const Scalar length = std::sqrt(x * x + y * y);
    const Scalar factor = turn / length;
    const Line line{-y * factor, x * factor, (y * from.x - x * from.y) * factor};
    cut([&](const Seen& s) { return line.at(s); }, from.edge, rounding);
  }
}

template <class Scalar>
void ContactPolygon<Scalar>::cut_by_segment(Scalar rounding) {
  const Seen &start = outline_[0], &end = outline_[1];
  const Scalar x = end.x - start.x, y = end.y - start.y;
  const Scalar length = std::sqrt(x * x + y * y);
  for (const Seen& s : subject_) {
    if (std::abs(x * (s.y - start.y) - y * (s.x - start.x)) > 4 * rounding * length) {
      return subject_.clear();
    }
  }
  const Scalar a = x / length, b = y / length;
  cut([&](const Seen& s) { return a * (s.x - start.x) + b * (s.y - start.y); }, start.edge,
      rounding);
  cut([&](const Seen& s) { return a * (end.x - s.x) + b * (end.y - s.y); }, end.edge, rounding);
}

template <class Scalar>
void ContactPolygon<Scalar>::merge_neighbours(std::vector<Seen>& loop, Scalar distance) {
  const auto near = [&](const Seen& p, const Seen& q) {
    return std::abs(p.x - q.x) <= distance && std::abs(p.y - q.y) <= distance;
  };
  bool apart = !loop.empty() && !near(loop.back(), loop.front());
  for (std::size_t k = 1; k < loop.size(); ++k) apart = apart && !near(loop[k - 1], loop[k]);
  if (apart) return;
  // The first of two merged corners keeps its place, and the second its edge.
  std::size_t kept = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    if (kept > 0 && near(loop[kept - 1], loop[k])) {
      loop[kept - 1].edge = loop[k].edge;
    } else {
      loop[kept++] = loop[k];
    }
  }
  if (kept > 1 && near(loop[kept - 1], loop[0])) --kept;
  loop.resize(kept);
}

template <class Scalar>
void ContactPolygon<Scalar>::cut_where_apart(const Line& height, bool subject_is_a,
                                             Scalar rounding) {
  const Scalar sign = subject_is_a ? Scalar{1} : Scalar{-1};
  cut([&](const Seen& s) { return sign * (s.height - height.at(s)); }, parting, rounding);
}

template <class Scalar>
void ContactPolygon<Scalar>::finish(const Line& height, bool subject_is_a, Scalar rounding) {
  merge_neighbours(subject_, 4 * rounding);
  if (subject_.empty()) return;
  std::uint16_t before = subject_.back().edge;
  for (const Seen& s : subject_) {
    const Scalar other = height.at(s);
    const Scalar on_a = subject_is_a ? s.height : other, on_b = subject_is_a ? other : s.height;
    corners_.push_back({s.x, s.y, on_a, on_b, on_a - on_b, before, s.edge});
    before = s.edge;
  }
  if (doubled_area(corners_) >= 0) return;
  std::reverse(corners_.begin(), corners_.end());
}

template <class Scalar>
void ContactPolygon<Scalar>::find(const ContactFeature<Scalar>& a, const ContactFeature<Scalar>& b,
                                  const Vec3<Scalar>& normal, Scalar rounding) {
  corners_.clear();
  if (a.points.empty() || b.points.empty()) return;
  frame_ = Frame(normal);
  see(a, first_of_a, subject_);
  see(b, first_of_b, outline_);
  // A polygon narrower than rounding becomes a segment or a point.
  merge_neighbours(subject_, 4 * rounding);
  merge_neighbours(outline_, 4 * rounding);
  if (subject_.size() < 2 || outline_.size() < 2) return;
  // A segment never clips a polygon; of two polygons the smaller is clipped.
  const auto extent = [](const std::vector<Seen>& loop) {
    const Seen &p = loop[0], &q = loop[loop.size() / 2];
    return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
  };
  const bool subject_is_a =
      outline_.size() > 2 && (subject_.size() == 2 || extent(subject_) < extent(outline_));
  if (!subject_is_a) std::swap(subject_, outline_);
  const Line height = height_of(subject_is_a ? b : a, outline_);
  // This cut comes first, because it may leave little for the others to clip.
  cut_where_apart(height, subject_is_a, rounding);
  if (outline_.size() > 2) {
    cut_by_polygon(rounding);
  } else {
    cut_by_segment(rounding);
  }
  finish(height, subject_is_a, rounding);
}

template <class Scalar>
void ContactPolygon<Scalar>::find_on_plane(const ContactFeature<Scalar>& a, Scalar height,
                                           const Vec3<Scalar>& normal, Scalar rounding) {
  corners_.clear();
  if (a.points.empty()) return;
  frame_ = Frame(normal);
  see(a, first_of_a, subject_);
  const Line plane{0, 0, height};
  cut_where_apart(plane, true, rounding);
  finish(plane, true, rounding);
}

template class ContactPolygon<float>;
template class ContactPolygon<double>;

}  // namespace touchstone

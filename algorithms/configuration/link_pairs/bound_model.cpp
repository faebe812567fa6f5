// Part of link-pairs: bounds of parts, and the phases that decide where bounds do not.
#include "algorithms/configuration/link_pairs/bound_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "algorithms/core/mesh/sole_shape.h"
#include "algorithms/core/orthonormal_error.h"

namespace touchstone {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
// Of the reach: more than poses are off that are rotations up to rounding, and their products.
constexpr double relative_slack = 0x1p-36;
// The orthonormal error of rotations up to rounding is less.
constexpr double most_rounded = 0x1p-44;

// Of what no configuration moves: later than any.
constexpr std::uint64_t always = std::numeric_limits<std::uint64_t>::max();

// A square that underflows may be any.
double root(double squared) {
  return squared >= std::numeric_limits<double>::min() ? std::sqrt(squared) : 0;
}

// The box along the axes around points, and a ball about its centre.
PartBounds around(std::span<const Vec3d> points) {
  PartBounds bounds;
  if (points.empty()) {
    bounds.radius = -infinite;
    return bounds;
  }
  Vec3d low = points.front(), high = points.front();
  for (const Vec3d& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  bounds.centre = low + (high - low) / 2;
  bounds.half = (high - low) / 2;
  double squared = 0;
  for (const Vec3d& point : points) {
    squared = std::max(squared, (point - bounds.centre).squaredNorm());
  }
  bounds.radius = std::sqrt(squared);
  return bounds;
}

PartBounds around(const Shape& shape) {
  PartBounds bounds;
  switch (shape.kind) {
    case ShapeKind::sphere:
      bounds.half.setConstant(shape.radius);
      bounds.radius = shape.radius;
      bounds.is_ball = true;
      return bounds;
    case ShapeKind::capsule:
      bounds.half = Vec3d(shape.radius, shape.radius, shape.half_length + shape.radius);
      bounds.radius = shape.half_length + shape.radius;
      return bounds;
    case ShapeKind::box:
      bounds.half = shape.half_extents;
      bounds.is_box = true;
      break;
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      bounds.half = Vec3d(shape.radius, shape.radius, shape.half_length);
      bounds.radius = std::hypot(shape.radius, shape.half_length);
      return bounds;
    case ShapeKind::ellipsoid:
      bounds.half = shape.radii;
      bounds.radius = shape.radii.maxCoeff();
      return bounds;
    case ShapeKind::hull: return around(std::span<const Vec3d>(shape.hull->vertices));
    case ShapeKind::halfspace:
      bounds.half.setConstant(infinite);
      bounds.radius = infinite;
      bounds.normal = shape.normal / shape.normal.norm();
      bounds.offset = shape.offset / shape.normal.norm();
      return bounds;
  }
  bounds.radius = bounds.half.norm();
  return bounds;
}

void move(PartBounds& bounds, const Pose& pose) {
  bounds.centre = pose(bounds.centre);
  bounds.axes = pose.rotation * bounds.axes;
  if (!bounds.is_plane()) return;
  bounds.normal = pose.rotation * bounds.normal;
  bounds.offset += bounds.normal.dot(pose.translation);
}

// Around the boxes of all parts.
PartBounds around_parts(std::span<const ConvexPart> parts) {
  std::vector<Vec3d> corners;
  for (const ConvexPart& part : parts) {
    PartBounds bounds = around(part.shape);
    if (bounds.radius < 0) continue;
    if (!std::isfinite(bounds.radius)) {
      PartBounds boundless;
      boundless.half.setConstant(infinite);
      boundless.radius = infinite;
      return boundless;
    }
    move(bounds, part.pose);
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3d sign((corner & 1) * 2 - 1, (corner & 2) - 1, (corner & 4) / 2 - 1);
      corners.emplace_back(bounds.centre + bounds.axes * sign.cwiseProduct(bounds.half));
    }
  }
  return around(corners);
}

PartBounds bounds_of(const ConcaveBody& body) {
  if (body.mesh) {
    std::vector<Vec3d> corners;
    for (const auto& triangle : body.mesh->triangles) {
      for (const std::uint32_t corner : triangle) corners.push_back(body.mesh->vertices[corner]);
    }
    return around(corners);
  }
  if (const Shape* const shape = sole_shape(body)) return around(*shape);
  return around_parts(body.parts);
}

}  // namespace

void BoundModel::bind(const ConfigurationModel& model, const ConfigurationSettings& settings) {
  model_ = &model;
  const std::size_t count = model.parts.size();
  bounds_.clear();
  is_convex_.clear();
  shapes_.assign(count, Shape{});
  bodies_.clear();
  reach_ = error_of_parts_ = 0;
  bool some_convex = false, some_concave = false;
  for (std::size_t i = 0; i < count; ++i) {
    const ModelPart& part = model.parts[i];
    PartBounds& bounds = bounds_.emplace_back(bounds_of(part.body));
    move(bounds, part.pose);
    error_of_parts_ = std::max(error_of_parts_, orthonormal_error(part.pose.rotation));
    for (const ConvexPart& convex : part.body.parts) {
      error_of_parts_ = std::max(error_of_parts_, orthonormal_error(convex.pose.rotation));
    }
    const Shape* const shape = sole_shape(part.body);
    const bool convex = shape != nullptr;
    is_convex_.push_back(convex ? 1 : 0);
    if (convex) shapes_[i] = *shape;
    bodies_.push_back(part.body);
    (convex ? some_convex : some_concave) = true;
    if (bounds.is_plane()) reach_ = std::max(reach_, std::abs(bounds.offset));
    if (std::isfinite(bounds.radius)) {
      reach_ =
          std::max(reach_, bounds.centre.norm() + bounds.radius + part.pose.translation.norm());
    }
  }
  pairs_.clear();
  for (const IndexPair& pair : model.pairs) {
    if (bounds_[pair.a].radius >= 0 && bounds_[pair.b].radius >= 0) pairs_.push_back(pair);
  }
  own_number_.resize(count);
  std::iota(own_number_.begin(), own_number_.end(), 0U);
  narrow_ = nullptr;
  concave_ = nullptr;
  if (some_convex) {
    narrow_ = settings.narrow_phase();
    narrow_->bind(shapes_);
  }
  if (some_concave) {
    concave_ = settings.concave_phase();
    concave_->bind(bodies_);
  }
  now_ = 0;
  placed_links_.assign(model.links, Pose{});
  still_since_.assign(model.links, 0);
  known_of_contact_.clear();
  known_of_distance_.clear();
  for (auto* placed : {&placed_centres_, &placed_axes_, &placed_poses_}) placed->assign(count, 0);
  centres_.assign(count, Vec3d::Zero());
  axes_.assign(count, Mat3d::Identity());
  poses_.assign(count, Pose{});
  for (std::size_t i = 0; i < count; ++i) {
    if (model.parts[i].link != ModelPart::world) continue;
    placed_centres_[i] = placed_axes_[i] = placed_poses_[i] = always;
    centres_[i] = bounds_[i].centre;
    axes_[i] = bounds_[i].axes;
    poses_[i] = model.parts[i].pose;
  }
}

void BoundModel::place(std::span<const Pose> links) {
  links_ = links;
  ++now_;
  double furthest = 0, error = error_of_parts_;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const Pose& link = links[i];
    if (link.translation != placed_links_[i].translation ||
        link.rotation != placed_links_[i].rotation) {
      placed_links_[i] = link;
      still_since_[i] = now_;
    }
    furthest = std::max(furthest, link.translation.cwiseAbs().maxCoeff());
    error = std::max(error, orthonormal_error(link.rotation));
  }
  is_rigid_ = error <= most_rounded;
  slack_ = (relative_slack + (is_rigid_ ? 0 : slack_of_error * error)) * (furthest + reach_);
}

void BoundModel::place_centre(std::uint32_t part) {
  centres_[part] = links_[link_of(part)](bounds_[part].centre);
  placed_centres_[part] = now_;
}

const Mat3d& BoundModel::axes(std::uint32_t part) {
  if (placed_axes_[part] < now_) {
    axes_[part] = links_[link_of(part)].rotation * bounds_[part].axes;
    placed_axes_[part] = now_;
  }
  return axes_[part];
}

const Pose& BoundModel::pose(std::uint32_t part) {
  if (placed_poses_[part] < now_) {
    poses_[part] = placed(model_->parts[part], links_);
    placed_poses_[part] = now_;
  }
  return poses_[part];
}

double BoundModel::squared_gap_of_box(const Vec3d& point, std::uint32_t part) {
  const Vec3d within = axes(part).transpose() * (point - centre(part));
  return (within.cwiseAbs() - bounds_[part].half).cwiseMax(0).squaredNorm();
}

// Paper: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996: fifteen axes, on which a gap is certain that is more than
// the slack. NaN, of boundless boxes, is no gap.
bool BoundModel::boxes_are_apart(std::uint32_t a, std::uint32_t b) {
  const Mat3d& of_a = axes(a);
  const Mat3d turn = of_a.transpose() * axes(b);
  const Mat3d size = turn.cwiseAbs();
  const Vec3d way = of_a.transpose() * (centre(b) - centre(a));
  const Vec3d &half_a = bounds_[a].half, &half_b = bounds_[b].half;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(way[i]) > half_a[i] + size.row(i).dot(half_b) + slack_) return true;
  }
  for (int k = 0; k < 3; ++k) {
    if (std::abs(way.dot(turn.col(k))) > half_b[k] + size.col(k).dot(half_a) + slack_) return true;
  }
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int k = 0; k < 3; ++k) {
      const int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      const double along = std::abs(way[i2] * turn(i1, k) - way[i1] * turn(i2, k));
      const double both = half_a[i1] * size(i2, k) + half_a[i2] * size(i1, k) +
                          half_b[k1] * size(i, k2) + half_b[k2] * size(i, k1);
      // The axis is no longer than 1.
      if (along > both + 4 * slack_) return true;
    }
  }
  return false;
}

BoundModel::Bound BoundModel::bound(const IndexPair& pair) {
  const auto [a, b] = pair;
  for (const auto& [part, ground] : {IndexPair{a, b}, IndexPair{b, a}}) {
    if (!is_ground(ground)) continue;
    const double above = height(part, ground);
    if (above > slack_) return Bound::apart;
    return bounds_[part].is_ball && above < -slack_ ? Bound::touch : Bound::open;
  }
  if (balls_are_apart(a, b)) return Bound::apart;
  const PartBounds &of_a = bounds_[a], &of_b = bounds_[b];
  const auto within = [&](double squared, double reach) {
    const double sure = reach - slack_, most = sure * sure;
    return sure > 0 && std::isnormal(most) && squared <= most ? Bound::touch : Bound::open;
  };
  if (of_a.is_ball && of_b.is_ball) {
    return within((centre(a) - centre(b)).squaredNorm(), of_a.radius + of_b.radius);
  }
  for (const auto& [ball, box] : {IndexPair{a, b}, IndexPair{b, a}}) {
    const double squared = squared_gap_of_box(centre(ball), box);
    const double radius = bounds_[ball].radius, reach = radius + slack_;
    if (is_beyond(squared, reach)) return Bound::apart;
    if (!bounds_[ball].is_ball) continue;
    return bounds_[box].is_box ? within(squared, radius) : Bound::open;
  }
  return boxes_are_apart(a, b) ? Bound::apart : Bound::open;
}

BoundModel::Gap BoundModel::gap(const IndexPair& pair) {
  const auto [a, b] = pair;
  // A bound that overflows says nothing.
  const auto bounded = [&](double bound, bool is_exact) -> Gap {
    if (!std::isfinite(bound)) return {-infinite, false};
    return {bound, is_exact && is_rigid_};
  };
  for (const auto& [part, ground] : {IndexPair{a, b}, IndexPair{b, a}}) {
    if (!is_ground(ground)) continue;
    return bounded(height(part, ground), bounds_[part].is_ball);
  }
  const PartBounds &of_a = bounds_[a], &of_b = bounds_[b];
  double least = root((centre(a) - centre(b)).squaredNorm()) - of_a.radius - of_b.radius;
  if (of_a.is_ball && of_b.is_ball) return bounded(least, true);
  for (const auto& [ball, box] : {IndexPair{a, b}, IndexPair{b, a}}) {
    const double found = root(squared_gap_of_box(centre(ball), box)) - bounds_[ball].radius;
    if (bounds_[ball].is_ball && bounds_[box].is_box) return bounded(found, true);
    least = std::max(least, found);
  }
  return bounded(least, false);
}

const Outcome& BoundModel::ask(Task task, const IndexPair& pair) {
  const std::uint64_t since = std::max(still_since(pair.a), still_since(pair.b));
  if (since == now_) {
    solve(task, pair, outcome_);
    return outcome_;
  }
  auto& all = task == Task::intersect ? known_of_contact_ : known_of_distance_;
  Known& known = all[(std::uint64_t{pair.a} << 32) + pair.b];
  if (known.since <= since) {
    solve(task, pair, known.outcome);
    known.since = now_;
  }
  return known.outcome;
}

void BoundModel::solve(Task task, const IndexPair& pair, Outcome& outcome) {
  outcome.answer = Answer::unknown;
  outcome.status = Status::unsupported;
  if (is_convex_[pair.a] != 0 && is_convex_[pair.b] != 0) {
    std::uint32_t first = pair.a, second = pair.b;
    if (shapes_[first].kind > shapes_[second].kind) std::swap(first, second);
    pose(first);
    pose(second);
    const PairBatch batch = {shapes_[first].kind,
                             shapes_[second].kind,
                             {{&first, 1}, {&second, 1}, own_number_, poses_}};
    narrow_->solve_alone(task, batch, 0, outcome);
    return;
  }
  touching_.clear();
  concave_->solve(task == Task::intersect ? ConcaveTask::intersect : ConcaveTask::distance,
                  {pair.a, pose(pair.a)}, {pair.b, pose(pair.b)}, outcome, touching_);
}

BoundModel::Verdict BoundModel::decide(const IndexPair& pair) {
  const Outcome& outcome = ask(Task::intersect, pair);
  const bool touches = outcome.answer == Answer::touching || outcome.answer == Answer::overlapping;
  return {touches ? Answer::overlapping : outcome.answer, outcome.status};
}

Outcome BoundModel::measure(const IndexPair& pair) {
  Outcome outcome = ask(Task::distance, pair);
  if (outcome.answer == Answer::touching || outcome.answer == Answer::overlapping) {
    outcome.answer = Answer::overlapping;
    outcome.distance = 0;
  }
  return outcome;
}

}  // namespace touchstone

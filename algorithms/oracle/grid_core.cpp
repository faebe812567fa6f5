// One core of a pair: supports in doubles and integers, and points of curved cores.
#include "algorithms/oracle/grid_core.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algorithms/oracle/numbers/dyadic.h"
#include "algorithms/oracle/numbers/square_root.h"

namespace touchstone::oracle {
namespace {

using Vec3l = Vec3<long double>;

// Returns the furthest point of a cylinder, cone or ellipsoid around the origin.
Vec3l furthest(Solid::Core core, const Vec3l& extents, const Vec3l& direction) {
  if (core == Solid::Core::ellipsoid) {
    const Vec3l stretched = extents.cwiseProduct(direction);
    const long double length = stretched.norm();
    if (!(length > 0)) return Vec3l::Zero();
    return extents.cwiseProduct(Vec3l(stretched / length));
  }
  const long double across = std::hypot(direction.x(), direction.y());
  Vec3l rim(0, 0, direction.z() < 0 ? -extents.z() : extents.z());
  if (across > 0) {
    rim.x() = extents.x() * (direction.x() / across);
    rim.y() = extents.y() * (direction.y() / across);
  }
  if (core == Solid::Core::cylinder) return rim;
  const Vec3l tip(0, 0, extents.z());
  rim.z() = -extents.z();
  return tip.dot(direction) >= rim.dot(direction) ? tip : rim;
}

// Floor and ceiling of sqrt(square) * 2^shift.
SupportBounds root_bounds(const Integer& square, int shift) {
  const Integer scaled = square << (2 * shift);
  const Integer root = root_below(scaled);
  return {root, root * root == scaled ? root : root + 1};
}

}  // namespace

Direction make_direction(IntegerVector exact) {
  long bits = 0;
  for (const Integer& x : exact) {
    if (!x.is_zero()) bits = std::max(bits, static_cast<long>(msb(x < 0 ? Integer(-x) : x)) + 1);
  }
  Direction direction{std::move(exact), Vec3d::Zero()};
  const long drop = std::max(bits - 60, 0L);
  const double unit = std::ldexp(1.0, static_cast<int>(drop - bits));
  for (int k = 0; k < 3; ++k) {
    // The shift takes the magnitude because Boost 1.74 loses the sign of some negative numbers.
    const Integer top = abs(direction.exact[k]) >> drop;
    const double magnitude = unit * static_cast<double>(top.convert_to<std::int64_t>());
    direction.rounded[k] = direction.exact[k] < 0 ? -magnitude : magnitude;
  }
  return direction;
}

void GridCore::place(const Body& body, const Mat3d& matrix, double scale, const Vec3d& origin,
                     const Vec3d& sweep) {
  solid_ = body.solid;
  matrix_ = matrix;
  scale_ = scale;
  origin_ = origin;
  is_swept_ = body.sweep.has_value();
  sweep_ = sweep;
  points_.clear();
  at_end_.clear();
  const std::size_t count = solid_->x.size(), all = is_swept_ ? 2 * count : count;
  x_.resize(all);
  y_.resize(all);
  z_.resize(all);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3d point = turned({solid_->x[i], solid_->y[i], solid_->z[i]});
    x_[i] = point.x();
    y_[i] = point.y();
    z_[i] = point.z();
  }
  for (std::size_t i = count; i < all; ++i) {
    x_[i] = x_[i - count] + sweep.x();
    y_[i] = y_[i - count] + sweep.y();
    z_[i] = z_[i - count] + sweep.z();
  }
}

Generator GridCore::generator(std::uint32_t i) const {
  Generator generator;
  if (!solid_->is_curved()) {
    generator.vertex = static_cast<std::int32_t>(i);
    return generator;
  }
  for (int k = 0; k < 3; ++k) {
    generator.point[k] = std::ldexp(static_cast<long double>(points_[i][k]), solid_->grid[k]);
  }
  return generator;
}

std::uint32_t GridCore::support(const Vec3d& direction) {
  if (solid_->is_curved()) {
    return add_point((matrix_.transpose().cast<long double>() * direction.cast<long double>()),
                     is_swept_ && direction.dot(sweep_) > 0);
  }
  const std::size_t count = x_.size();
  std::uint32_t best = 0;
  double furthest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    const double value = direction.x() * x_[i] + direction.y() * y_[i] + direction.z() * z_[i];
    if (value > furthest) {
      furthest = value;
      best = static_cast<std::uint32_t>(i);
    }
  }
  return best;
}

Integer GridCore::extent(int k) const {
  return dyadic(solid_->extents[k]).over_power(solid_->grid[k]);
}

bool GridCore::holds(const std::array<std::int64_t, 3>& point) const {
  const Integer x = point[0], y = point[1], z = point[2];
  const Integer a = extent(0), b = extent(1), c = extent(2);
  switch (solid_->core) {
    case Solid::Core::ellipsoid: {
      // An axis of zero length admits only coordinate 0, so it is left out.
      Integer left = 0, right = 1;
      const std::array<const Integer*, 3> coordinates = {&x, &y, &z}, axes = {&a, &b, &c};
      for (int k = 0; k < 3; ++k) {
        if (axes[k]->is_zero()) continue;
        const Integer square = *axes[k] * *axes[k];
        left = left * square + *coordinates[k] * *coordinates[k] * right;
        right *= square;
      }
      return left <= right;
    }
    case Solid::Core::cylinder: return x * x + y * y <= a * a && abs(z) <= c;
    case Solid::Core::cone: {
      if (abs(z) > c) return false;
      const Integer height = 2 * c, left = c - z;
      return (x * x + y * y) * height * height <= a * a * left * left;
    }
    case Solid::Core::polytope:
    case Solid::Core::halfspace: break;
  }
  return false;
}

static_assert(std::numeric_limits<long double>::digits >= 64,
              "exact answers about curved bodies need a long double of at least 64 bits; "
              "results/other_machines.md says which machines have it");

std::uint32_t GridCore::add_point(const Vec3l& local_direction, bool at_end) {
  Vec3l extents;
  for (int k = 0; k < 3; ++k) {
    extents[k] = std::ldexp(static_cast<long double>(solid_->extents[k]), -solid_->grid[k]);
  }
  // Each axis has its own grid, so lengths in grid steps differ between axes.
  Vec3l units;
  for (int k = 0; k < 3; ++k) {
    units[k] = std::ldexp(1.0L, solid_->grid[k] - solid_->exponent);
  }
  const Vec3l real = furthest(solid_->core, extents.cwiseProduct(units), local_direction);
  const bool apex = solid_->core == Solid::Core::cone && real.z() > 0;
  std::array<std::int64_t, 3> point{};
  // A rounded point may lie outside. It is shrunk towards the centre, more each time, until it is
  // inside.
  for (long double shrink = 0;; shrink = shrink > 0 ? 4 * shrink : 0x1p-64L) {
    for (int k = 0; k < 3; ++k) {
      if (extents[k] == 0) continue;
      const bool flat_end = solid_->core != Solid::Core::ellipsoid && k == 2;
      const long double factor = flat_end ? 1 : 1 - shrink;
      point[k] = static_cast<std::int64_t>(std::trunc(real[k] * factor / units[k]));
    }
    if (apex || holds(point)) break;
  }
  points_.push_back(point);
  at_end_.push_back(at_end ? 1 : 0);
  Vec3d rounded;
  for (int k = 0; k < 3; ++k) {
    rounded[k] = static_cast<double>(static_cast<long double>(point[k]) * units[k]);
  }
  Vec3d place = turned(rounded);
  if (at_end) place += sweep_;
  x_.push_back(place.x());
  y_.push_back(place.y());
  z_.push_back(place.z());
  return static_cast<std::uint32_t>(x_.size() - 1);
}

void GridCore::place_exactly(const ExactMatrix& matrix, long exponent, const Integer& others,
                             const IntegerVector& origin, IntegerVector sweep) {
  exact_sweep_ = std::move(sweep);
  for (int k = 0; k < 3; ++k) {
    const Integer step =
        solid_->is_box ? dyadic(solid_->vertices[7][k]).over_power(solid_->grid[k]) : Integer(1);
    const long shift = matrix.exponent + solid_->grid[k] - exponent;
    for (int row = 0; row < 3; ++row) {
      const Integer& entry = matrix.columns[k][row];
      // A zero entry may belong to a grid that is too fine for this shift.
      columns_[k][row] = entry.is_zero() || step.is_zero()
                             ? Integer(0)
                             : Integer((entry * step * others) << shift);
    }
  }
  exact_origin_ = origin;
  known_.assign(x_.size(), 0);
  exact_.resize(std::max(exact_.size(), x_.size()));
}

const IntegerVector& GridCore::exact(std::uint32_t i) {
  if (known_.size() < x_.size()) {
    known_.resize(x_.size(), 0);
    exact_.resize(std::max(exact_.size(), x_.size()));
  }
  IntegerVector& point = exact_[i];
  if (known_[i]) return point;
  known_[i] = 1;
  point = exact_origin_;
  if (is_at_end(i)) point = point + exact_sweep_;
  const std::size_t own = solid_->is_curved() ? i : i % solid_->x.size();
  for (int k = 0; k < 3; ++k) {
    if (solid_->is_box) {
      for (int row = 0; row < 3; ++row) {
        if (own >> k & 1) {
          point[row] += columns_[k][row];
        } else {
          point[row] -= columns_[k][row];
        }
      }
      continue;
    }
    const Integer steps = solid_->is_curved()
                              ? Integer(points_[own][k])
                              : dyadic(solid_->vertices[own][k]).over_power(solid_->grid[k]);
    if (steps.is_zero()) continue;
    for (int row = 0; row < 3; ++row) point[row] += columns_[k][row] * steps;
  }
  return point;
}

std::uint32_t GridCore::exact_support(const Direction& direction, double filter_scale) {
  if (solid_->is_curved()) return support(direction.rounded);
  const double error = filter_scale * dot_error;
  const Vec3d& n = direction.rounded;
  const std::size_t count = x_.size();
  double furthest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < count; ++i) {
    furthest = std::max(furthest, n.x() * x_[i] + n.y() * y_[i] + n.z() * z_[i]);
  }
  // All vertices that may be the furthest are compared exactly.
  std::uint32_t best = 0;
  bool found = false, measured = false;
  Integer value;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (n.x() * x_[i] + n.y() * y_[i] + n.z() * z_[i] < furthest - 2 * error) continue;
    if (!found) {
      found = true;
      best = i;
      continue;
    }
    if (!measured) {
      measured = true;
      value = dot(direction.exact, exact(best));
    }
    Integer other = dot(direction.exact, exact(i));
    if (other > value) {
      value = std::move(other);
      best = i;
    }
  }
  return best;
}

SupportBounds GridCore::support_bounds(const IntegerVector& direction, int shift) const {
  // Components of the direction along the solid's axes, times the extents.
  std::array<Integer, 3> along;
  for (int k = 0; k < 3; ++k) along[k] = dot(direction, columns_[k]) * extent(k);
  const Integer& end = along[2];
  SupportBounds bounds;
  switch (solid_->core) {
    case Solid::Core::ellipsoid:
      bounds = root_bounds(along[0] * along[0] + along[1] * along[1] + end * end, shift);
      break;
    case Solid::Core::cylinder:
      bounds = root_bounds(along[0] * along[0] + along[1] * along[1], shift);
      bounds.low += abs(end) << shift;
      bounds.high += abs(end) << shift;
      break;
    case Solid::Core::cone: {
      const SupportBounds rim = root_bounds(along[0] * along[0] + along[1] * along[1], shift);
      const Integer tip = end << shift;
      bounds = {std::max(tip, Integer(rim.low - tip)), std::max(tip, Integer(rim.high - tip))};
      break;
    }
    case Solid::Core::polytope:
    case Solid::Core::halfspace: break;
  }
  Integer at = dot(direction, exact_origin_) << shift;
  if (is_swept_) {
    const Integer further = dot(direction, exact_sweep_);
    if (further > 0) at += further << shift;
  }
  bounds.low += at;
  bounds.high += at;
  return bounds;
}

}  // namespace touchstone::oracle

// The affine frame of affine_frame.h, computed in double-double precision.
#include "algorithms/hull/affine_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace touchstone {
namespace {

// A set thinner than this, relative to the greatest distance between points, is flat up to
// rounding.
constexpr double flat = 0x1p-48;

double largest(const Vec3d& v) { return v.cwiseAbs().maxCoeff(); }

template <class Measure>
std::size_t argmax(const std::vector<DoubleDouble3>& v, Measure measure) {
  std::size_t best = 0;
  double greatest = -1;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const double m = measure(v[i]);
    if (m > greatest) {
      greatest = m;
      best = i;
    }
  }
  return best;
}

// Returns offsets from the first point, scaled to about 1 in two steps, so that nothing overflows.
std::vector<DoubleDouble3> scaled_offsets(const std::vector<Vec3d>& points) {
  double magnitude = 0;
  for (const Vec3d& p : points) magnitude = std::max(magnitude, largest(p));
  std::vector<DoubleDouble3> offsets;
  offsets.reserve(points.size());
  if (magnitude == 0) {
    offsets.resize(points.size());
    return offsets;
  }
  const int down = -std::ilogb(magnitude) - 2;
  const auto scaled = [](const Vec3d& p, int exponent) {
    return Vec3d(std::ldexp(p.x(), exponent), std::ldexp(p.y(), exponent),
                 std::ldexp(p.z(), exponent));
  };
  const Vec3d origin = scaled(points.front(), down);
  double length = 0;
  for (const Vec3d& p : points) {
    offsets.push_back(DoubleDouble3::difference(scaled(p, down), origin));
    length = std::max(length, largest(offsets.back().value()));
  }
  if (length == 0) return offsets;
  const int up = -std::ilogb(length);
  for (DoubleDouble3& d : offsets) {
    for (DoubleDouble* c : {&d.x, &d.y, &d.z}) {
      *c = {std::ldexp(c->high, up), std::ldexp(c->low, up)};
    }
  }
  return offsets;
}

}  // namespace

OwnFrame own_frame(const std::vector<Vec3d>& points) {
  OwnFrame frame;
  frame.points.assign(points.size(), Vec3d::Zero());
  frame.offsets = scaled_offsets(points);
  std::vector<DoubleDouble3>& d = frame.offsets;
  const auto length = [](const DoubleDouble3& x) { return x.value().norm(); };
  // The frame's origin is an extreme point: the one farthest from the first.
  const DoubleDouble3 origin = d[argmax(d, length)];
  for (DoubleDouble3& x : d) x = x - origin;
  const DoubleDouble3 u = d[argmax(d, length)];
  const double size = length(u);
  if (size == 0) return frame;

  const auto width = [&](const DoubleDouble3& x) { return length(cross(u, x)); };
  const DoubleDouble3 v = d[argmax(d, width)];
  const DoubleDouble3 uv = cross(u, v);
  const double area = length(uv);
  const auto ratio = [](const DoubleDouble& a, double b) { return a.value() / b; };
  if (area <= flat * size * size) {
    frame.dimension = 1;
    for (std::size_t i = 0; i < d.size(); ++i) {
      frame.points[i].x() = ratio(dot(u, d[i]), size * size);
    }
    return frame;
  }

  const auto height = [&](const DoubleDouble3& x) { return std::abs(dot(uv, x).value()); };
  const DoubleDouble3 w = d[argmax(d, height)];
  frame.thickness = height(w) / area / size;
  if (frame.thickness <= flat) {
    frame.dimension = 2;
    for (std::size_t i = 0; i < d.size(); ++i) {
      frame.points[i].x() = ratio(dot(cross(d[i], v), uv), area * area);
      frame.points[i].y() = ratio(dot(cross(u, d[i]), uv), area * area);
    }
    return frame;
  }

  frame.dimension = 3;
  frame.thickness = std::min(frame.thickness, area / size / size);
  const double volume = dot(uv, w).value();
  const DoubleDouble3 vw = cross(v, w), wu = cross(w, u);
  for (std::size_t i = 0; i < d.size(); ++i) {
    Vec3d& p = frame.points[i];
    p = {ratio(dot(vw, d[i]), volume), ratio(dot(wu, d[i]), volume), ratio(dot(uv, d[i]), volume)};
    if (volume < 0) std::swap(p.x(), p.y());  // keeps anticlockwise loops anticlockwise
  }
  return frame;
}

}  // namespace touchstone

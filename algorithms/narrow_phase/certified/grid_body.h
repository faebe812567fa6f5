// Part of certified: a polytope whose vertices are placed on the grid of integers when they are
// first asked for. Includes this folder.
#pragma once

#include <algorithm>
#include <boost/container/static_vector.hpp>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/narrow_phase/certified/placed_body.h"

namespace touchstone {

// Coordinates relative to the pose of a body of the pair, in steps of 2^step. Directions are in
// world axes, of unit length.
template <std::size_t size>
class GridBody {
 public:
  using Point = FixedVector<size>;
  // No more are placed. Memory is not touched before it is used.
  static constexpr std::size_t most_points = 128;

  // The references must outlive this object; `heights` is memory to work in.
  GridBody(const PlacedBody& body, const SplitPose& split, int step, std::vector<double>& heights)
      : solid_(body.shape.solid),
        points_of_solid_(body.shape.split),
        centre_(body.shape.support().centre),
        pose_(body.pose),
        split_(split),
        step_(step),
        heights_(heights) {}

  // Lists the vertices within `slab` (metres) of the support plane along the direction. Returns
  // false if they are too many.
  bool list_near(const Vec3d& direction, double slab) {
    const Vec3d along = pose_.rotation.transpose() * direction;
    const auto count = static_cast<Eigen::Index>(solid_.vertices.size());
    heights_.resize(solid_.vertices.size());
    Eigen::Map<Eigen::ArrayXd> heights(heights_.data(), count);
    const auto all = [&](const std::vector<double>& values) {
      return Eigen::Map<const Eigen::ArrayXd>(values.data(), count);
    };
    heights = along.x() * all(solid_.x) + along.y() * all(solid_.y) + along.z() * all(solid_.z);
    const double limit = heights.maxCoeff() - std::ldexp(slab, -solid_.exponent);
    near_.clear();
    for (std::size_t i = 0; i < heights_.size(); ++i) {
      if (heights_[i] < limit) continue;
      const auto point = place(static_cast<std::uint32_t>(i));
      if (!point) return false;
      near_.push_back(static_cast<std::uint8_t>(*point));
    }
    return !near_.empty();
  }
  // Indices of the points that the last call of list_near listed.
  std::span<const std::uint8_t> near() const { return {near_.data(), near_.size()}; }

  // Returns the index of a vertex among the points, or nothing if there is no room.
  std::optional<std::size_t> place(std::uint32_t vertex) {
    const auto found = std::ranges::find(vertices_, vertex);
    const auto i = static_cast<std::size_t>(found - vertices_.begin());
    if (found != vertices_.end()) return i;
    if (i == most_points) return std::nullopt;
    vertices_.push_back(vertex);
    points_.push_back(on_grid<size>(split_, points_of_solid_[vertex], step_));
    return i;
  }

  const Point& operator[](std::size_t i) const { return points_[i]; }

  // The listed point that is nearest to a support point of this body in a pair: in the pair's unit
  // (metres), relative to the centre of body a, from which `centre` is this body's.
  std::size_t nearest(const Vec3d& support, double unit, const Vec3d& centre) const {
    const Vec3d place = unit * (support - centre) + pose_.rotation * centre_;
    return *std::ranges::min_element(near_, {}, [&](std::size_t i) {
      return (pose_.rotation * solid_.vertices[vertices_[i]] - place).squaredNorm();
    });
  }

 private:
  template <class T>
  using Few = boost::container::static_vector<T, most_points>;

  const oracle::Solid& solid_;
  const std::vector<SplitPoint>& points_of_solid_;
  const Vec3d& centre_;  // of the shape's support points
  const Pose& pose_;
  const SplitPose& split_;
  int step_;
  std::vector<double>& heights_;  // of all vertices, in 2^exponent of the solid
  Few<std::uint32_t> vertices_;
  Few<Point> points_;  // of these vertices
  Few<std::uint8_t> near_;
};

}  // namespace touchstone

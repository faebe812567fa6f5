// A tree of boxes over a body's parts, in its frame: the phase between broad and narrow.
// Paper: van den Bergen, "Efficient collision detection of complex deformable models using AABB
//        trees", J. Graphics Tools 2(4), 1997.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/core/pose.h"
#include "harness/proxies/representation.h"

namespace touchstone::trade {

class PartTree {
 public:
  explicit PartTree(std::span<const proxies::Part> parts);

  struct Node {
    Vec3d centre, half;         // metres, body frame; rounded outward
    std::uint32_t left, right;  // nodes; in a leaf, left == leaf and right is the part
    static constexpr std::uint32_t leaf = std::numeric_limits<std::uint32_t>::max();
    bool is_leaf() const { return left == leaf; }
  };
  const std::vector<Node>& nodes() const { return nodes_; }  // the root first
  // A point of each part, body frame.
  const Vec3d& point(std::uint32_t part) const { return points_[part]; }
  // A half-space is alone in its tree, and has no box.
  bool is_plane() const { return is_plane_; }
  const Vec3d& normal() const { return normal_; }  // unit
  double offset() const { return offset_; }

 private:
  std::uint32_t split(std::span<std::uint32_t> parts, std::span<const Node> boxes);

  std::vector<Node> nodes_;
  std::vector<Vec3d> points_;
  bool is_plane_ = false;
  Vec3d normal_ = Vec3d::UnitZ();
  double offset_ = 0;
};

// The pose of a part in the world.
inline Pose placed(const Pose& body, const Pose& part) {
  return {body.rotation * part.rotation, body.rotation * part.translation + body.translation};
}

// A part of a, and a part of b.
using PartPair = std::pair<std::uint32_t, std::uint32_t>;

// Appends every pair of parts whose boxes meet; pairs of parts that do not meet may be among them.
void meeting_parts(const PartTree& a, const Pose& pose_a, const PartTree& b, const Pose& pose_b,
                   std::vector<PartPair>& pairs);

// Appends pairs of parts that may be the nearest; the nearest pair is among them.
void nearest_parts(const PartTree& a, const Pose& pose_a, const PartTree& b, const Pose& pose_b,
                   std::vector<PartPair>& pairs);

}  // namespace touchstone::trade

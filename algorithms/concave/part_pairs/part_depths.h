// Part of part-pairs: depths of pairs of parts, a narrow phase as the last resort. Includes core, kernels and this folder.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "algorithms/concave/part_pairs/bound_body.h"
#include "algorithms/concave/part_pairs/convex_pairs.h"
#include "algorithms/concave_phase.h"
#include "algorithms/kernels/gjk/gjk_query.h"

namespace touchstone {

class PartDepths {
 public:
  // The bodies stay alive, and their parts unchanged.
  void bind(std::span<const BoundBody> bodies);

  // Returns the outcome of each of these pairs of parts of two of the bodies, which share a point, with its
  // depth, the normal and witness points. The narrow phase of `others` is asked about parts that touch,
  // whose place is rounded by more than their depth, or whose depth has no bounds. The outcomes stay valid
  // until the next call.
  std::span<const Outcome> find(const PlacedConcave& a, const PlacedConcave& b,
                                std::span<const IndexPair> pairs, ConvexPairs& others);

 private:
  // A triangle as a shape; its corners change.
  class Triangle {
   public:
    Triangle();
    const SupportShape<double>& prepare(const TriangleCorners& corners);

   private:
    std::shared_ptr<Hull> hull_;
    Shape shape_;
    std::optional<SupportShape<double>> prepared_;
  };
  // The part of a body that was last asked for.
  static constexpr std::uint32_t none = ~0U;
  struct Side {
    std::uint32_t part = none;
    const SupportShape<double>* shape = nullptr;  // null: a triangle that is not prepared yet
    double half_length = 0;                       // of a capsule (metres)
    TriangleCorners corners = {};                 // of a triangle, in the body's coordinates
    ComposedPose placed = {};
    Triangle triangle;
  };
  // These return true if the parts surely overlap. The normal is from the triangle to the sphere or capsule.
  static bool find_depth_of_round(const Side& round, const Side& triangle, Outcome& outcome);
  bool find_depth(Outcome& outcome);
  void place(const PlacedConcave& body, std::uint32_t part, Side& side) const;

  std::span<const BoundBody> bodies_;
  std::vector<SupportShape<double>> parts_;  // the convex parts of all bodies, in their order
  std::vector<double> reaches_;              // of these: of their points from the origin (metres)
  std::vector<std::uint32_t> first_part_;    // of each body
  Side a_, b_;
  GjkQuery<double> query_{GjkQuerySettings{}};
  std::vector<Outcome> outcomes_;
  std::vector<std::uint32_t> left_;  // numbers of pairs for the narrow phase
  std::vector<IndexPair> left_pairs_;
};

}  // namespace touchstone

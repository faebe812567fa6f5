// Part of link-pairs: a tree of the obstacles' boxes, which is asked for the balls of links.
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/configuration/link_pairs/link_groups.h"
#include "algorithms/configuration/link_pairs/pair_search.h"
#include "algorithms/kernels/bvh/wide_search.h"

namespace touchstone {

class WorldTree final : public PairSearch {
 public:
  using PairSearch::PairSearch;

 private:
  void prepare(const ConfigurationModel& model) override {
    groups_ = LinkGroups(model_, model);
    std::vector<Aabb> boxes;
    for (const std::uint32_t part : groups_.world()) boxes.push_back(box_of(model_.bounds(part)));
    tree_ = build_wide_bvh(boxes);
    reach_of_tree_ = 0;
    for (const std::uint32_t part : groups_.world()) {
      const PartBounds& bounds = model_.bounds(part);
      if (!std::isfinite(bounds.radius)) continue;
      reach_of_tree_ =
          std::max(reach_of_tree_, bounds.centre.cwiseAbs().maxCoeff() + bounds.radius);
    }
    centres_.resize(model.links);
  }

  IndexPair search(std::span<const Pose> links) override {
    for (std::uint32_t i = 0; i < links.size(); ++i) {
      const LinkGroup& link = groups_.links()[i];
      if (link.parts.empty()) continue;
      centres_[i] = links[i](link.centre);
      find_near(centres_[i], link.radius + model_.slack());
      for (const std::uint32_t part : link.parts) {
        for (const std::uint32_t place : near_) {
          const std::uint32_t other = groups_.world()[place];
          if (!groups_.asks(part, other)) continue;
          const IndexPair pair = {std::min(part, other), std::max(part, other)};
          if (is_some(settle({&pair, 1}))) return pair;
        }
      }
    }
    for (const LinkPairs& pair : groups_.pairs()) {
      const double reach =
          groups_.links()[pair.a].radius + groups_.links()[pair.b].radius + model_.slack();
      if (is_beyond((centres_[pair.a] - centres_[pair.b]).squaredNorm(), reach)) continue;
      const IndexPair sure = settle(pair.pairs);
      if (is_some(sure)) return sure;
    }
    return nothing;
  }

  // Rounded outward, with room for the rounding of the box.
  static Aabb box_of(const PartBounds& bounds) {
    constexpr float unbounded = std::numeric_limits<float>::infinity();
    Aabb box;
    box.min.fill(-unbounded);
    box.max.fill(unbounded);
    if (!std::isfinite(bounds.radius)) return box;
    const Vec3d half = bounds.axes.cwiseAbs() * bounds.half;
    for (int i = 0; i < 3; ++i) {
      const double reach = half[i] + 0x1p-40 * (std::abs(bounds.centre[i]) + half[i]);
      box.min[static_cast<std::size_t>(i)] = round_down(bounds.centre[i] - reach);
      box.max[static_cast<std::size_t>(i)] = round_up(bounds.centre[i] + reach);
    }
    return box;
  }

  // The obstacles whose boxes are no further from the centre than `reach`, and more of their leaves.
  void find_near(const Vec3d& centre, double reach) {
    near_.clear();
    // Squares of floats may not underflow.
    const SearchBox ball =
        search_box(centre, centre, std::max(reach, 1e-18), Pose{}, 0, reach_of_tree_);
    search_.run(
        tree_, ball,
        [](void* context, std::uint32_t leaf) {
          auto& self = *static_cast<WorldTree*>(context);
          std::ranges::copy(self.tree_.leaf(leaf), std::back_inserter(self.near_));
          return true;
        },
        this);
  }

  LinkGroups groups_;
  WideBvh tree_;
  double reach_of_tree_ = 0;  // no bounded obstacle has a greater coordinate (metres)
  WideSearch search_;
  std::vector<Vec3d> centres_;  // of the links' balls
  std::vector<std::uint32_t> near_;
};

}  // namespace touchstone

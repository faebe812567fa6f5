// Part of link-pairs: a tree of the obstacles' boxes, which is asked for the balls of links.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/configuration/link_pairs/link_groups.h"
#include "algorithms/configuration/link_pairs/pair_search.h"
#include "algorithms/kernels/bvh/wide_bvh.h"

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
          if (is_some(settle(pair))) return pair;
        }
      }
    }
    for (const LinkPairs& pair : groups_.pairs()) {
      const double reach =
          groups_.links()[pair.a].radius + groups_.links()[pair.b].radius + model_.slack();
      if (is_beyond((centres_[pair.a] - centres_[pair.b]).squaredNorm(), reach)) continue;
      for (const IndexPair& parts : pair.pairs) {
        if (is_some(settle(parts))) return parts;
      }
    }
    return nothing;
  }

  // Rounded outward, with room for the rounding of the box.
  static Aabb box_of(const PartBounds& bounds) {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    const Vec3d half = bounds.axes.cwiseAbs() * bounds.half;
    Aabb box;
    for (int i = 0; i < 3; ++i) {
      const double room = 0x1p-40 * (std::abs(bounds.centre[i]) + half[i]);
      const bool is_bounded = std::isfinite(bounds.radius);
      const auto axis = static_cast<std::size_t>(i);
      box.min[axis] =
          is_bounded
              ? std::nextafter(static_cast<float>(bounds.centre[i] - half[i] - room), -infinite)
              : -infinite;
      box.max[axis] =
          is_bounded
              ? std::nextafter(static_cast<float>(bounds.centre[i] + half[i] + room), infinite)
              : infinite;
    }
    return box;
  }

  // The obstacles whose boxes are no further from the centre than `reach`, and more of their leaves.
  void find_near(const Vec3d& centre, double reach) {
    near_.clear();
    if (tree_.nodes.empty()) return;
    open_nodes_.assign(1, 0);
    // Boxes and distances are rounded to floats.
    const double wide = reach + 0x1p-20 * (centre.cwiseAbs().maxCoeff() + reach);
    const auto x = static_cast<float>(centre.x()), y = static_cast<float>(centre.y()),
               z = static_cast<float>(centre.z());
    // A square that overflows is infinite, and none is so small that it underflows.
    const auto most = std::max(static_cast<float>(wide * wide * (1 + 0x1p-20)), 1e-36F);
    while (!open_nodes_.empty()) {
      const WideNode& node = tree_.nodes[open_nodes_.back()];
      open_nodes_.pop_back();
      for (std::size_t lane = 0; lane < WideNode::fan; ++lane) {
        if (node.child[lane] == WideNode::no_child) break;
        const auto gap = [&](std::size_t axis, float at) {
          const float low = node.planes[axis][lane] - at, high = at - node.planes[axis + 3][lane];
          return std::max(std::max(low, high), 0.0F);
        };
        const float on_x = gap(0, x), on_y = gap(1, y), on_z = gap(2, z);
        if (!(on_x * on_x + on_y * on_y + on_z * on_z <= most)) continue;
        if (!WideNode::is_leaf(node.child[lane])) {
          open_nodes_.push_back(static_cast<std::uint32_t>(node.child[lane]));
          continue;
        }
        for (const std::uint32_t place : tree_.leaf(WideNode::leaf(node.child[lane]))) {
          near_.push_back(place);
        }
      }
    }
  }

  LinkGroups groups_;
  WideBvh tree_;
  std::vector<Vec3d> centres_;  // of the links' balls
  std::vector<std::uint32_t> open_nodes_, near_;
};

}  // namespace touchstone

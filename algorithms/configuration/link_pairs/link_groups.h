// Part of link-pairs: the parts of each link with a ball around them, and which pairs of them are asked.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/configuration/link_pairs/bound_model.h"

namespace touchstone {

struct LinkGroup {
  std::vector<std::uint32_t> parts;  // those of which some pair is asked
  Vec3d centre = Vec3d::Zero();      // in the link's frame
  double radius =
      0;  // of the ball; infinite if a part has no bounds, without a meaning if there are no parts
};

// Two links of which some pair of parts is asked.
struct LinkPairs {
  std::uint32_t a, b;
  std::vector<IndexPair> pairs;
};

class LinkGroups {
 public:
  LinkGroups() = default;
  LinkGroups(const BoundModel& bounds, const ConfigurationModel& model);

  std::span<const LinkGroup> links() const { return links_; }
  std::span<const LinkPairs> pairs() const { return pairs_; }
  // The parts of the world of which some pair is asked.
  std::span<const std::uint32_t> world() const { return world_; }
  bool asks(std::uint32_t part, std::uint32_t of_world) const {
    return asked_[std::size_t{row_[part]} * parts_ + of_world] != 0;
  }
  bool asks_link(std::uint32_t link, std::uint32_t of_world) const {
    return asked_links_[std::size_t{link} * parts_ + of_world] != 0;
  }

 private:
  std::size_t parts_ = 0;
  std::vector<LinkGroup> links_;
  std::vector<LinkPairs> pairs_;
  std::vector<std::uint32_t> world_;
  std::vector<std::uint32_t> row_;  // of a part of a link: its row in `asked_`
  std::vector<char> asked_;         // by part of a link, and part of the world
  std::vector<char> asked_links_;   // by link, and part of the world
};

}  // namespace touchstone

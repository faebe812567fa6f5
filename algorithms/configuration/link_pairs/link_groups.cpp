// Part of link-pairs: groups parts and pairs by their links.
#include "algorithms/configuration/link_pairs/link_groups.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace touchstone {

LinkGroups::LinkGroups(const BoundModel& bounds, const ConfigurationModel& model)
    : parts_(model.parts.size()),
      links_(model.links),
      row_(parts_, 0),
      asked_links_(model.links * parts_, 0) {
  std::uint32_t rows = 0;
  for (std::size_t part = 0; part < parts_; ++part) {
    if (model.parts[part].link != ModelPart::world) row_[part] = rows++;
  }
  asked_.assign(std::size_t{rows} * parts_, 0);
  std::vector<char> is_asked(parts_, 0);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> places;
  for (const IndexPair& pair : bounds.pairs()) {
    is_asked[pair.a] = is_asked[pair.b] = 1;
    std::uint32_t moving = pair.a, other = pair.b;
    if (model.parts[moving].link == ModelPart::world) std::swap(moving, other);
    const std::uint32_t first = model.parts[moving].link, second = model.parts[other].link;
    if (second == ModelPart::world) {
      asked_[std::size_t{row_[moving]} * parts_ + other] = 1;
      asked_links_[std::size_t{first} * parts_ + other] = 1;
      continue;
    }
    const auto [at, is_new] = places.try_emplace(std::minmax(first, second), pairs_.size());
    if (is_new) pairs_.push_back({std::min(first, second), std::max(first, second), {}});
    pairs_[at->second].pairs.push_back(pair);
  }
  for (std::uint32_t part = 0; part < parts_; ++part) {
    if (is_asked[part] == 0) continue;
    const std::uint32_t link = model.parts[part].link;
    (link == ModelPart::world ? world_ : links_[link].parts).push_back(part);
  }
  for (LinkGroup& link : links_) {
    if (link.parts.empty()) continue;
    const PartBounds& one = bounds.bounds(link.parts.front());
    if (link.parts.size() == 1) {
      link.centre = one.centre;
      link.radius = one.radius;
      continue;
    }
    Vec3d low = one.centre, high = one.centre;
    bool is_bounded = true;
    for (const std::uint32_t part : link.parts) {
      const PartBounds& of = bounds.bounds(part);
      is_bounded = is_bounded && std::isfinite(of.radius);
      low = low.cwiseMin(of.centre - Vec3d::Constant(of.radius));
      high = high.cwiseMax(of.centre + Vec3d::Constant(of.radius));
    }
    if (!is_bounded) {
      link.radius = std::numeric_limits<double>::infinity();
      continue;
    }
    link.centre = low + (high - low) / 2;
    for (const std::uint32_t part : link.parts) {
      const PartBounds& of = bounds.bounds(part);
      link.radius = std::max(link.radius, (of.centre - link.centre).norm() + of.radius);
    }
  }
}

}  // namespace touchstone

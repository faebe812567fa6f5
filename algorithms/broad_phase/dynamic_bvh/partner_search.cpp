// Searches the tree for the partners of some bodies.
#include "algorithms/broad_phase/dynamic_bvh/partner_search.h"

#include "algorithms/core/memory_usage.h"

namespace touchstone {

void PartnerSearch::search(const HilbertRTree& bulk, std::span<const std::uint32_t> leavers,
                           Bvh16Scratch& scratch, Partners& out) {
  const Bvh16& tree = bulk.tree();
  out.ids.clear();
  for (std::size_t i = 0; i < leavers.size(); ++i) {
    const Aabb fat_box = tree.box_at(tree.place_of(leavers[i]));
    for (const std::uint32_t other : tree.find(fat_box, scratch)) {
      if (other != leavers[i]) out.ids.push_back(other);
    }
    out.ends[i] = out.ids.size();
  }
}

std::size_t PartnerSearch::held_bytes() const {
  std::size_t bytes = touchstone::held_bytes(found_);
  for (const Partners& found : found_) bytes += touchstone::held_bytes(found.ids);
  return bytes;
}

}  // namespace touchstone

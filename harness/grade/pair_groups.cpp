#include "harness/grade/pair_groups.h"

#include <fmt/core.h>

#include <array>
#include <utility>

namespace touchstone {

std::string PairGroup::name() const {
  return fmt::format("{}-{}", to_string(kind_a), to_string(kind_b));
}

PairBatch PairGroup::batch(std::span<const std::uint32_t> shape_of, std::span<const Pose> poses,
                           std::size_t begin, std::size_t end) const {
  const std::size_t count = end - begin;
  return {.kind_a = kind_a,
          .kind_b = kind_b,
          .pairs = {.first = std::span(first).subspan(begin, count),
                    .second = std::span(second).subspan(begin, count),
                    .shape_of = shape_of,
                    .poses = poses}};
}

std::vector<PairGroup> group_by_kind(std::span<const IndexPair> pairs,
                                     std::span<const Shape> shapes,
                                     std::span<const std::uint32_t> shape_of) {
  constexpr std::size_t kinds = all_shape_kinds.size();
  std::array<PairGroup, kinds * kinds> table;
  for (const IndexPair& pair : pairs) {
    std::uint32_t first = pair.a;
    std::uint32_t second = pair.b;
    const auto kind = [&](std::uint32_t body) { return shapes[shape_of[body]].kind; };
    if (kind(first) > kind(second)) std::swap(first, second);
    PairGroup& group = table[static_cast<std::size_t>(kind(first)) * kinds +
                             static_cast<std::size_t>(kind(second))];
    group.kind_a = kind(first);
    group.kind_b = kind(second);
    group.first.push_back(first);
    group.second.push_back(second);
  }
  std::vector<PairGroup> groups;
  for (PairGroup& group : table) {
    if (group.size() > 0) groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace touchstone

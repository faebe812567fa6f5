// Sorts pairs into groups by the kinds of their shapes.
#include "harness/grade/pair_groups.h"

#include <fmt/core.h>

#include <utility>

namespace touchstone::grade {

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

void PairGrouping::clear() {
  for (PairGroup& group : groups_) {
    group.first.clear();
    group.second.clear();
  }
}

std::size_t PairGrouping::add(std::uint32_t first, ShapeKind first_kind, std::uint32_t second,
                              ShapeKind second_kind) {
  if (first_kind > second_kind) {
    std::swap(first, second);
    std::swap(first_kind, second_kind);
  }
  const std::size_t place = index(first_kind, second_kind);
  PairGroup& group = groups_[place];
  group.kind_a = first_kind;
  group.kind_b = second_kind;
  group.first.push_back(first);
  group.second.push_back(second);
  return place;
}

std::vector<PairGroup> group_by_kind(std::span<const IndexPair> pairs,
                                     std::span<const Shape> shapes,
                                     std::span<const std::uint32_t> shape_of) {
  PairGrouping grouping;
  const auto kind = [&](std::uint32_t body) { return shapes[shape_of[body]].kind; };
  for (const IndexPair& pair : pairs) grouping.add(pair.a, kind(pair.a), pair.b, kind(pair.b));
  std::vector<PairGroup> groups;
  for (const PairGroup& group : grouping.groups()) {
    if (group.size() > 0) groups.push_back(group);
  }
  return groups;
}

}  // namespace touchstone::grade

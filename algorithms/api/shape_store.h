// Shapes that a solver knows, and the algorithms that are bound to them.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <vector>

#include "algorithms/api/choice.h"

namespace touchstone::v1 {

// The shapes and what holds them stay alive until they are forgotten.
class ShapeStore {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  ShapeStore(const Choice& choice, const NarrowPhaseSettings& settings)
      : choice_(choice),
        settings_(settings),
        pairs_(choice.pair_entries.size()),
        casts_(choice.cast_entries.size()),
        table_(2) {}

  std::size_t size() const { return shapes_.size(); }
  const touchstone::Shape& shape(std::uint32_t place) const { return shapes_[place]; }

  // Returns the place of the shape with that id, or `none`.
  std::uint32_t find(std::uint64_t id) const {
    for (std::size_t at = id & (table_.size() - 1);; at = (at + 1) & (table_.size() - 1)) {
      if (table_[at].id == id) return table_[at].place;
      if (table_[at].id == 0) return none;
    }
  }

  // Returns the place of the shape, which is kept from now on. The algorithms are bound again at their next use.
  std::uint32_t add(const Shape& shape) {
    const Shape::Data& data = data_of(shape);
    if (const std::uint32_t place = find(data.id); place != none) return place;
    const auto place = static_cast<std::uint32_t>(shapes_.size());
    // What is bound has spans of the old array, and is not asked before it is bound again.
    unbind();
    held_.push_back(shape);
    shapes_.push_back(data.shape);
    if (2 * shapes_.size() > table_.size()) {
      grow();
    } else {
      enter(data.id, place);
    }
    return place;
  }

  void forget() {
    unbind();
    shapes_.clear();
    held_.clear();
    std::ranges::fill(table_, Entry{});
  }

  // The algorithm at that place of the choice, bound to all shapes.
  NarrowPhase& narrow_phase(std::uint8_t which) {
    Bound<NarrowPhase>& bound = pairs_[which];
    if (!bound.is_bound) [[unlikely]]
      bind(bound, *choice_.pair_entries[which], settings_);
    return *bound.algorithm;
  }
  Cast& cast(std::uint8_t which) {
    Bound<Cast>& bound = casts_[which];
    if (!bound.is_bound) [[unlikely]]
      bind(bound, *choice_.cast_entries[which], CastSettings{});
    return *bound.algorithm;
  }

 private:
  struct Entry {
    std::uint64_t id = 0;  // 0: free
    std::uint32_t place = none;
  };
  template <class Algorithm>
  struct Bound {
    std::unique_ptr<Algorithm> algorithm;
    bool is_bound = false;
  };

  template <class Algorithm, class AlgorithmEntry, class Settings>
  void bind(Bound<Algorithm>& bound, const AlgorithmEntry& entry, const Settings& settings) {
    if (!bound.algorithm) bound.algorithm = entry.make(settings);
    bound.algorithm->bind(shapes_);
    bound.is_bound = true;
  }
  void unbind() {
    for (auto& bound : pairs_) bound.is_bound = false;
    for (auto& bound : casts_) bound.is_bound = false;
  }
  void enter(std::uint64_t id, std::uint32_t place) {
    std::size_t at = id & (table_.size() - 1);
    while (table_[at].id != 0) at = (at + 1) & (table_.size() - 1);
    table_[at] = {id, place};
  }
  void grow() {
    table_.assign(std::bit_ceil(4 * shapes_.size()), {});
    for (std::uint32_t i = 0; i < held_.size(); ++i) enter(held_[i].data()->id, i);
  }

  const Choice& choice_;
  NarrowPhaseSettings settings_;
  std::vector<Bound<NarrowPhase>> pairs_;
  std::vector<Bound<Cast>> casts_;
  std::vector<Shape> held_;
  std::vector<touchstone::Shape> shapes_;
  std::vector<Entry> table_;  // its size is a power of two
};

}  // namespace touchstone::v1

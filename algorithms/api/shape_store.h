// Shapes that a solver knows, and the algorithms that are bound to them.
#pragma once

#include <algorithm>
#include <array>
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
    const Entry* const table = table_.data();
    for (std::size_t at = id & mask_;; at = (at + 1) & mask_) {
      if (table[at].id == id) return table[at].place;
      if (table[at].id == 0) return none;
    }
  }

  // Writes the places of two, and returns whether it has both. Few ids are not where they are looked for first.
  bool find(std::uint64_t id_a, std::uint64_t id_b, std::array<std::uint32_t, 2>& places) const {
    const Entry &a = table_.data()[id_a & mask_], &b = table_.data()[id_b & mask_];
    if (a.id == id_a && b.id == id_b) [[likely]] {
      places = {a.place, b.place};
      return true;
    }
    places = {find(id_a), find(id_b)};
    return places[0] != none && places[1] != none;
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

  // The algorithm that answers one pair of these kinds, a <= b, bound to all shapes; null if there is none.
  NarrowPhase* alone(Task task, ShapeKind a, ShapeKind b) {
    const auto of_task = static_cast<std::size_t>(task), i = static_cast<std::size_t>(a),
               j = static_cast<std::size_t>(b);
    NarrowPhase*& algorithm = alone_[(8 * of_task + i) * 8 + j];
    if (algorithm == nullptr) [[unlikely]] {
      const std::uint8_t which = choice_.alone[of_task][i][j];
      if (which != Choice::none) algorithm = &narrow_phase(which);
    }
    return algorithm;
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
    alone_.fill(nullptr);
    for (auto& bound : pairs_) bound.is_bound = false;
    for (auto& bound : casts_) bound.is_bound = false;
  }
  void enter(std::uint64_t id, std::uint32_t place) {
    std::size_t at = id & mask_;
    while (table_[at].id != 0) at = (at + 1) & mask_;
    table_[at] = {id, place};
  }
  void grow() {
    table_.assign(std::bit_ceil(4 * shapes_.size()), {});
    mask_ = table_.size() - 1;
    for (std::uint32_t i = 0; i < held_.size(); ++i) enter(held_[i].data()->id, i);
  }

  const Choice& choice_;
  NarrowPhaseSettings settings_;
  std::vector<Bound<NarrowPhase>> pairs_;
  std::vector<Bound<Cast>> casts_;
  std::vector<Shape> held_;
  std::vector<touchstone::Shape> shapes_;
  std::vector<Entry> table_;               // its size is a power of two
  std::size_t mask_ = 1;                   // less one
  std::array<NarrowPhase*, 256> alone_{};  // for each task and two kinds, those that are bound
};

}  // namespace touchstone::v1

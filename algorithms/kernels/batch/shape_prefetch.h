// Prefetching for the next pairs of a batch while earlier ones are solved: poses and shapes, then
// the support-map cells of large hulls for their first supports, then the vertices that these cells
// name. A scene's many large hulls are in no near cache, and their first support direction, the
// line of the centres, is known beforehand.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "algorithms/core/body_pairs.h"
#include "algorithms/kernels/batch/prefetch.h"
#include "algorithms/kernels/minkowski/support_shape.h"

namespace touchstone {

template <class Scalar>
class ShapePrefetch {
 public:
  // The items must stay in place; `support_of` selects an item's shape.
  template <class Item, class Projection = std::identity>
  void bind(const std::vector<Item>& items, Projection support_of = {}) {
    shapes_.clear();
    for (const Item& item : items) shapes_.push_back(&std::invoke(support_of, item));
    has_cells_ = std::ranges::any_of(
        shapes_, [](const SupportShape<Scalar>* shape) { return !shape->cells.empty(); });
  }

  // `far_too` is true if pairs whose bounding balls are disjoint compute supports too.
  void begin(const BodyPairs& pairs, bool far_too) {
    pairs_ = pairs;
    far_too_ = far_too;
    next_ = {};
  }
  // Call this before solving each of the pairs, in their order.
  void before(std::size_t pair) {
    if (!has_cells_) return;
    const std::size_t size = pairs_.first.size();
    if (pair + 3 < size) {
      prefetch_body(pairs_.first[pair + 3]);
      prefetch_body(pairs_.second[pair + 3]);
    }
    for (const Place& place : next_) {
      if (place.cell != nullptr) place.shape->cells.prefetch_blocks(*place.cell);
    }
    next_ = {};
    if (pair + 2 < size) find_cells(pairs_.first[pair + 2], pairs_.second[pair + 2]);
  }

 private:
  struct Place {
    const SupportShape<Scalar>* shape = nullptr;
    const typename SupportCubeMap<Scalar>::Cell* cell = nullptr;
  };

  void prefetch_body(std::uint32_t body) const {
    prefetch(&pairs_.poses[body], sizeof(Pose));
    prefetch(shapes_[pairs_.shape_of[body]], sizeof(SupportShape<Scalar>));
  }

  void find_cells(std::uint32_t first, std::uint32_t second) {
    const SupportShape<Scalar>& a = *shapes_[pairs_.shape_of[first]];
    const SupportShape<Scalar>& b = *shapes_[pairs_.shape_of[second]];
    const Pose &pose_a = pairs_.poses[first], &pose_b = pairs_.poses[second];
    Vec3d way = pose_b.translation - pose_a.translation;
    if (!a.is_centred) way -= pose_a.rotation * a.centre;
    if (!b.is_centred) way += pose_b.rotation * b.centre;
    // Such a pair is decided without any support: balls_are_apart uses matrices.
    const double reach = a.size + a.radius + b.size + b.radius;
    if (!far_too_ && way.squaredNorm() > 3 * reach * reach) return;
    next_[0] = find_cell(a, pose_a.rotation.transpose() * way);
    next_[1] = find_cell(b, pose_b.rotation.transpose() * -way);
  }
  static Place find_cell(const SupportShape<Scalar>& shape, const Vec3d& direction) {
    if (shape.cells.empty()) return {};
    const auto& cell =
        shape.cells.cell_of(static_cast<Scalar>(direction.x()), static_cast<Scalar>(direction.y()),
                            static_cast<Scalar>(direction.z()));
    __builtin_prefetch(&cell);
    return {&shape, &cell};
  }

  std::vector<const SupportShape<Scalar>*> shapes_;
  BodyPairs pairs_{};
  bool has_cells_ = false, far_too_ = false;
  std::array<Place, 2> next_;  // cells of the next pair but one
};

}  // namespace touchstone

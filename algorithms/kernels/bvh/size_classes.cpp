// Size classes: the sample, the rule, and the choice of the instruction level.
#include "algorithms/kernels/bvh/size_classes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <numeric>

#include "algorithms/core/isa.h"
#include "algorithms/kernels/boxes/aabb_simd.h"

namespace touchstone {
namespace {

constexpr int magnitude_shift = 22;
// The bits that stand for the longest side of an empty box, in the last magnitude and above all
// sides.
constexpr std::int32_t no_side = 0x7fffffff;
constexpr Aabb empty_box = Aabb::empty();

#define TOUCHSTONE_TARGET_NAMESPACE aabb_simd
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/bvh/size_classes.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

std::size_t magnitude(float side) {
  return std::bit_cast<std::uint32_t>(side) >> magnitude_shift & (SizeSample::magnitudes - 1);
}

// Returns the mean distance between this many bodies that fill a region, which may be flat or a
// line (metres).
double spacing(const CentreRegion& region, double bodies) {
  std::array<double, 3> extent;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent[axis] = (double{region.high[axis]} - region.low[axis]) / 2;
  }
  std::ranges::sort(extent, std::greater());
  const double space = std::cbrt(extent[0] * extent[1] * extent[2] / bodies);
  if (extent[2] >= space) return space;
  const double plane = std::sqrt(extent[0] * extent[1] / bodies);
  return extent[1] >= plane ? plane : extent[0] / bodies;
}

}  // namespace

SizeSample::SizeSample(std::span<const Aabb> boxes, std::size_t every) : stride(every) {
  switch (isa()) {
    case Isa::avx512: avx512::sample(boxes, stride, region, members); break;
    case Isa::avx2: avx2::sample(boxes, stride, region, members); break;
    case Isa::baseline: baseline::sample(boxes, stride, region, members); break;
  }
  members.back() = 0;  // those without a side
}

SizeSample take_sample(std::span<const Aabb> boxes) {
  SizeSample sample(boxes, std::max<std::size_t>(1, boxes.size() / 1024));
  return sample.empty() && sample.stride > 1 ? SizeSample(boxes, 1) : sample;
}

SizeClasses::SizeClasses(const SizeSample& sample) {
  constexpr double most_spacings = 5;
  const auto& members = sample.members;
  const auto sum = [&](std::size_t first, std::size_t last) {
    return std::accumulate(&members[first], members.data() + last, std::uint32_t{0});
  };
  std::uint32_t bodies = sum(0, members.size());
  while (bodies > 0 && count_ + 2 < most) {
    const double all = static_cast<double>(bodies) * static_cast<double>(sample.stride);
    const auto side = static_cast<float>(most_spacings * spacing(sample.region, all));
    const std::size_t end = std::clamp(magnitude(side) + 1, end_, members.size());
    const std::uint32_t inside = sum(end_, end);
    if (inside == 0) break;  // all boxes overlap many others: size does not separate them
    add_class(end);
    bodies -= inside;
  }
  std::size_t seen = members.size();
  while (seen > end_ && members[seen - 1] == 0) --seen;
  // The last two classes: the rest, and boxes larger than any of the sample.
  for (const std::size_t end : {seen, members.size()}) {
    if (end > end_) add_class(end);
  }
  begins_[count_ - 1] = no_side;
}

// Gives a class to the magnitudes from end_ to `end`.
void SizeClasses::add_class(std::size_t end) {
  if (count_ > 0) begins_[count_ - 1] = static_cast<std::int32_t>(end_ << magnitude_shift);
  ++count_;
  end_ = end;
}

void SizeClasses::of(std::span<const Aabb> boxes, std::uint32_t* classes) const {
  const std::span<const std::int32_t> begins(begins_.data(), count_);
  switch (isa()) {
    case Isa::avx512: return avx512::classify(boxes, begins, classes);
    case Isa::avx2: return avx2::classify(boxes, begins, classes);
    case Isa::baseline: return baseline::classify(boxes, begins, classes);
  }
}

}  // namespace touchstone

// The nearest points of a segment and a box (plain_core.h proves the answer), and where they meet the
// least of the depths along the normals of their difference's faces.
//
// The difference of a box and a segment has the normals of the box and the products of its edges with
// the segment's. In the axes of the box, with q the segment's centre and d its half, these are e_k and
// (-d_j, d_i) for each two axes i and j, and the depths h_k + |d_k| - |q_k| and (h_i |d_j| + h_j |d_i| -
// |q_j d_i - q_i d_j|) / |(d_i, d_j)|. Rounding of q and d moves a body by as much, and a depth by no more.
#include "algorithms/narrow_phase/closed_form/plain_capsule_box.h"

#include <bit>
#include <limits>

#include "algorithms/kernels/simd/vector.h"
#include "algorithms/narrow_phase/closed_form/plain_core.h"

namespace touchstone {
namespace {

using namespace plain;
using simd::Quad;

struct CapsuleBox {
  Vec centre, half;  // of the box and of the segment, from the segment's centre: metres, world axes
  Vec x, y, z;       // the axes of the box
  Vec q, d;          // the segment's centre and half, from the centre of the box and along its axes
};

// The way out of the box that is least deep; the normal is from the segment to the box.
struct CapsuleDepth {
  double depth = std::numeric_limits<double>::infinity();
  Three normal{};
  int edge = -1;           // the axis of the edge of the box that it crosses; -1 for a face
  double edge_length = 0;  // of d across that edge
};

// A face is taken before an edge that is as deep up to `error`, since it has better points.
CapsuleDepth least_depth(const Three& q, const Three& d, const Vec3d& h, double error) {
  CapsuleDepth least;
  for (int k = 0; k < 3; ++k) {
    const double depth = h[k] + std::abs(d[k]) - std::abs(q[k]);
    if (!(depth < least.depth)) continue;
    least.depth = depth;
    least.normal = {};
    least.normal[k] = q[k] > 0 ? -1 : 1;
  }
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double square = d[i] * d[i] + d[j] * d[j];
    if (!(square > least_square)) continue;
    const double side = q[j] * d[i] - q[i] * d[j], across = std::sqrt(square);
    const double depth = (h[i] * std::abs(d[j]) + h[j] * std::abs(d[i]) - std::abs(side)) / across;
    if (!(depth < least.depth - error)) continue;
    const double scale = (side > 0 ? -1 : 1) / across;
    least.depth = depth;
    least.normal = {};
    least.normal[i] = -scale * d[j];
    least.normal[j] = scale * d[i];
    least.edge = k;
    least.edge_length = across;
  }
  return least;
}

// The s in [-1, 1] at which the segment is deepest, such that the point which is `depth` further back is
// on the box; NaN if rounding finds none.
double deepest(const CapsuleDepth& least, const Three& q, const Three& d, const Vec3d& h,
               double error) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double along = 0;
  for (int k = 0; k < 3; ++k) along += d[k] * least.normal[k];
  double s = along > 0 ? 1 : -1;
  if (least.edge >= 0) {
    // Where the line of the segment passes the box's edge, seen along the normal.
    const int i = (least.edge + 1) % 3, j = (least.edge + 2) % 3;
    const double at_i = least.normal[i] > 0 ? -h[i] : h[i];
    const double at_j = least.normal[j] > 0 ? -h[j] : h[j];
    s = (d[i] * (at_i - q[i]) + d[j] * (at_j - q[j])) / (least.edge_length * least.edge_length);
    const double clamped = clamp(s, -1, 1);
    if (!(std::abs(s - clamped) * least.edge_length <= error)) return none;
    s = clamped;
  } else {
    // A segment along the face may have an end beside it.
    double low = -1, high = 1;
    for (int k = 0; k < 3; ++k) {
      if (least.normal[k] != 0 || d[k] == 0) continue;
      const double one = (-h[k] - q[k]) / d[k], other = (h[k] - q[k]) / d[k];
      low = std::max(low, std::min(one, other));
      high = std::min(high, std::max(one, other));
    }
    const double kept = clamp(s, low, high);
    if (!(std::abs((s - kept) * along) <= error)) return none;
    s = clamp(kept, -1, 1);
  }
  for (int k = 0; k < 3; ++k) {
    const double on_box = q[k] + s * d[k] - least.depth * least.normal[k];
    if (!(std::abs(on_box) <= h[k] + error)) return none;
  }
  return s;
}

// The depth where the segment meets the box.
bool solve_depth(const CapsuleBox& pair, double radius, const Pose& pose_a, const Vec3d& h,
                 double size, Outcome& outcome) {
  const double error = (rounding + 8 * greatest_skew) * size;
  if (!(size > 1e-120 && size < 1e120) || !is_rotation(pair.x, pair.y, pair.z)) return false;
  const Three q = three(pair.q), d = three(pair.d);
  const CapsuleDepth least = least_depth(q, d, h, error);
  if (!(least.depth > error)) return false;
  const double s = deepest(least, q, d, h, error);
  if (!(std::abs(s) <= 1)) return false;
  write(Answer::overlapping, outcome);
  const Vec normal = least.normal[0] * pair.x + least.normal[1] * pair.y + least.normal[2] * pair.z;
  const Vec on_a = read(pose_a.translation) + s * pair.half;
  outcome.distance = -(least.depth + radius);
  outcome.lower = outcome.distance - error;
  outcome.upper = outcome.distance + error;
  outcome.normal = written(normal);
  outcome.witness_a = written(on_a + radius * normal);
  outcome.witness_b = written(on_a - least.depth * normal);
  return true;
}

// Answers with the point of the segment at t as the nearest to the box.
bool solve_at(Task task, double margin, double t, const CapsuleBox& pair, double radius,
              const Pose& pose_a, const Vec3d& h, Outcome& outcome) {
  const auto& [centre, half, x, y, z, q, d] = pair;
  const Vec on_a = t * half;
  const auto on_box = [&](double at, double step, int k) {
    return clamp(at + t * step, -h[k], h[k]);
  };
  const Vec on_b =
      centre + on_box(q.x, d.x, 0) * x + on_box(q.y, d.y, 1) * y + on_box(q.z, d.z, 2) * z;
  const Vec between = on_b - on_a;
  const double extent = std::abs(dot(between, half)) + h[0] * std::abs(dot(between, x)) +
                        h[1] * std::abs(dot(between, y)) + h[2] * std::abs(dot(between, z));
  const double longest = std::max(std::max(length(x), length(y)), length(z));
  const double size = length(centre) + length(half) + h.sum() * longest;
  const Nearest cores{on_a, on_b, between, dot(between, centre), extent, size};
  return answer(task, margin, cores, radius, 0, pose_a, outcome) ||
         (asks_depth(task) && solve_depth(pair, radius, pose_a, h, size + radius, outcome));
}

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/narrow_phase/closed_form/plain_capsule_box.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

PlainCapsuleBox plain_capsule_box() {
  switch (isa()) {
    case Isa::avx512: return avx512::solve_capsule_box;
    case Isa::avx2: return avx2::solve_capsule_box;
    default: return baseline::solve_capsule_box;
  }
}

}  // namespace touchstone

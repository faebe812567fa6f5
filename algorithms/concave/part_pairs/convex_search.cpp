// Each part searches the mesh's tree in its own frame, and tests the leaves that it finds.
#include "algorithms/concave/part_pairs/convex_search.h"

#include <array>
#include <bit>
#include <utility>

#include "algorithms/core/mesh/skew.h"

namespace touchstone {
namespace {

// The ball around a core is a ball in the world, whatever the rotation does to the core. In the part's
// frame it is an ellipsoid, whose points are off from the ball by less than this part of the radius.
double share_off_ball(const Mat3d& rotation) { return skew_of(rotation) + 0x1p-50; }
constexpr double greatest_skew = 0.1;

// The triangles of the bits.
std::span<const std::uint32_t> chosen(std::span<const std::uint32_t> leaf, unsigned bits,
                                      std::array<std::uint32_t, WideBvh::leaf_size>& room) {
  std::size_t count = 0;
  for (; bits != 0; bits &= bits - 1) {
    room[count++] = leaf[static_cast<std::size_t>(std::countr_zero(bits))];
  }
  return {room.data(), count};
}

struct LeafTest {
  const MeshTree& mesh;
  const LaneConvex& convex;
  const Pose& map;
  double error;
  std::uint32_t part;
  const ConvexSearch::Take& take;

  bool visit(std::uint32_t number) const {
    const auto leaf = mesh.tree.leaf(number);
    TriangleBlock moved;
    mesh.blocks.move(number, map, moved);
    const LaneVerdicts found = compare(convex, moved, (1u << leaf.size()) - 1, error);
    std::array<std::uint32_t, WideBvh::leaf_size> room;
    if (found.yes != 0 && !take(part, chosen(leaf, found.yes, room), false)) return false;
    return found.open == 0 || take(part, chosen(leaf, found.open, room), true);
  }
};

}  // namespace

void ConvexSearch::bind(std::span<const BoundBody> bodies) {
  bodies_ = bodies;
  parts_.clear();
  for (const BoundBody& body : bodies) {
    std::vector<Part>& parts = parts_.emplace_back();
    for (const ConvexPart& part : body.given->parts) {
      const LaneConvex convex(part.shape);
      const bool is_plain = part.rounding == 0 && part.pose.rotation == Mat3d::Identity() &&
                            part.pose.translation == Vec3d::Zero();
      parts.push_back({convex, convex.reach + convex.radius, is_plain});
    }
  }
}

bool ConvexSearch::find(const PlacedConcave& parts, const PlacedConcave& mesh, const Take& take) {
  const BoundBody& body = bodies_[parts.body];
  const double reach = bodies_[mesh.body].reach;
  placed_.clear();
  for (std::size_t i = 0; i < parts_[parts.body].size(); ++i) {
    const Part& part = parts_[parts.body][i];
    ComposedPose place = {parts.pose, 0};
    if (!part.is_plain) place = body.place(parts.pose, static_cast<std::uint32_t>(i), part.reach);
    const CommonFrame frame = common_frame(place.pose, part.reach, mesh.pose, reach);
    const bool is_round = part.convex.radius > 0;
    const double skew = is_round ? share_off_ball(place.pose.rotation) : 0;
    if (!frame.is_of_a || (is_round && !(skew <= greatest_skew))) return false;
    placed_.push_back({&part, frame.b,
                       frame.error + 2 * place.error + (is_round ? skew * part.convex.radius : 0)});
  }
  const MeshTree& tree = (*trees_)[mesh.body];
  for (std::uint32_t i = 0; i < placed_.size(); ++i) {
    const auto& [part, map, error] = placed_[i];
    const LaneConvex& convex = part->convex;
    const double radius = convex.radius > 0 ? convex.radius + error : 0;
    const SearchBox box = search_box(convex.low, convex.high, radius, map, error, reach);
    LeafTest test{tree, convex, map, error, i, take};
    const bool all = search_.run(
        tree.tree, box,
        [](void* context, std::uint32_t leaf) {
          return static_cast<LeafTest*>(context)->visit(leaf);
        },
        &test);
    if (!all) return true;
  }
  return true;
}

}  // namespace touchstone

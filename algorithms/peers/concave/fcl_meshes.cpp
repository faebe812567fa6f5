// FCL: trees of oriented boxes and swept spheres, of boxes, and of k-DOPs over meshes, descended together.
// Paper:   Pan, Chitta, Manocha, "FCL: A general purpose library for collision and proximity
//          queries", ICRA 2012; Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996; Larsen et al.,
//          UNC TR99-018, 1999; Klosowski et al., "Efficient collision detection using bounding volume
//          hierarchies of k-DOPs", TVCG 1998. The library is FCL 0.7: fcl::collide and fcl::distance of
//          BVHModel<OBBRSS>, fcl::collide of BVHModel<AABB> and BVHModel<KDOP<16>>, and each of a model and a
//          convex shape.
// Departs: contacts have neither points nor normals, which are not asked for, and as many as there
//          are: by default FCL stops at the first. A compound's parts are asked pair by pair, in
//          the order of their numbers, without a tree. Only double is asked for, as the binary has it.
// Fails:   a mesh is a surface. A rotation that is not orthonormal is taken for one that is. Pairs
//          of a mesh and a convex shape are those of FCL's narrow phase (fcl-libccd).
// Cost:    548 bytes a triangle with OBBRSS; allocates a result a query. The trees of AABB and k-DOP cannot
//          turn: FCL copies and refits both meshes for each query of two.
#include <cmath>
#include <memory>
#include <vector>

#include "algorithms/concave_phase.h"

#ifdef TOUCHSTONE_HAS_FCL
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include "algorithms/peers/fcl_mesh.h"
#include "algorithms/peers/fcl_shapes.h"

namespace touchstone {
namespace {

// BV is the volume of the trees.
template <class BV>
class FclMeshes final : public ConcavePhase {
 public:
  void bind(std::span<const ConcaveBody> bodies) override {
    bodies_.clear();
    for (const ConcaveBody& body : bodies) {
      std::vector<Part>& parts = bodies_.emplace_back();
      if (body.mesh && !body.mesh->triangles.empty()) {
        parts.push_back({fcl_shapes::make_fcl_mesh<BV>(*body.mesh), {}, true});
      }
      for (const ConvexPart& part : body.parts) {
        parts.push_back({fcl_shapes::make_fcl_shape<double>(part.shape), part.pose, false});
      }
    }
  }

  void solve(ConcaveTask task, const PlacedConcave& a, const PlacedConcave& b, Outcome& outcome,
             std::vector<IndexPair>& pairs) override {
    pairs.clear();
    outcome.status = Status::not_reported;
    outcome.answer = Answer::separated;
    const bool all = task == ConcaveTask::contacts;
    for (std::uint32_t i = 0; i < bodies_[a.body].size(); ++i) {
      for (std::uint32_t j = 0; j < bodies_[b.body].size(); ++j) {
        collide(bodies_[a.body][i], a.pose, i, bodies_[b.body][j], b.pose, j, all, pairs);
        if (!all && !pairs.empty()) break;
      }
      if (!all && !pairs.empty()) break;
    }
    if (!pairs.empty()) outcome.answer = Answer::overlapping;
    if (task == ConcaveTask::distance && pairs.empty()) find_nearest(a, b, outcome);
  }

 private:
  struct Part {
    std::shared_ptr<fcl::CollisionGeometry<double>> geometry;
    Pose pose;
    bool is_mesh;
  };

  static fcl::Transform3<double> place(const Pose& body, const Part& part) {
    Pose placed = body;
    if (!part.is_mesh) {
      placed.rotation = body.rotation * part.pose.rotation;
      placed.translation = body(part.pose.translation);
    }
    return fcl_shapes::to_fcl<double>(placed);
  }

  // A triangle's number if the part is a mesh, otherwise the part's.
  static std::uint32_t number(const Part& part, std::uint32_t own, int found) {
    return part.is_mesh ? static_cast<std::uint32_t>(found) : own;
  }

  static void collide(const Part& a, const Pose& pose_a, std::uint32_t i, const Part& b,
                      const Pose& pose_b, std::uint32_t j, bool all,
                      std::vector<IndexPair>& pairs) {
    // A mesh comes first, so that b1 is its triangle.
    const bool swap = !a.is_mesh && b.is_mesh;
    const fcl::CollisionRequest<double> request(all ? std::size_t{1} << 31 : 1, false);
    fcl::CollisionResult<double> result;
    const auto place_a = place(pose_a, a), place_b = place(pose_b, b);
    if (swap) {
      fcl::collide(b.geometry.get(), place_b, a.geometry.get(), place_a, request, result);
    } else {
      fcl::collide(a.geometry.get(), place_a, b.geometry.get(), place_b, request, result);
    }
    for (std::size_t k = 0; k < result.numContacts(); ++k) {
      const auto& contact = result.getContact(k);
      const auto of_first = static_cast<int>(contact.b1), of_second = static_cast<int>(contact.b2);
      pairs.push_back(
          {number(a, i, swap ? of_second : of_first), number(b, j, swap ? of_first : of_second)});
    }
  }

  void find_nearest(const PlacedConcave& a, const PlacedConcave& b, Outcome& outcome) const {
    const fcl::DistanceRequest<double> request(true);
    for (const Part& p : bodies_[a.body]) {
      for (const Part& q : bodies_[b.body]) {
        fcl::DistanceResult<double> result;
        const double found = fcl::distance(p.geometry.get(), place(a.pose, p), q.geometry.get(),
                                           place(b.pose, q), request, result);
        if (outcome.distance <= found) continue;
        outcome.distance = found;
        outcome.witness_a = result.nearest_points[0];
        outcome.witness_b = result.nearest_points[1];
      }
    }
  }

  std::vector<std::vector<Part>> bodies_;
};

// Makes the phase whose trees are of this volume. The library's binary has FCL's templates in double
// alone; in float they would take minutes to compile here.
template <class Volume>
std::unique_ptr<ConcavePhase> make_of(const ConcaveSettings&) {
  return std::make_unique<FclMeshes<Volume>>();
}

const auto make_obbrss = make_of<fcl::OBBRSS<double>>;
const auto make_aabb = make_of<fcl::AABB<double>>;
const auto make_kdop = make_of<fcl::KDOP<double, 16>>;

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<ConcaveEntry> peers_fcl_meshes() {
  ConcaveEntry entry = {
      .info = {.name = "fcl-obbrss",
               .citation = "FCL 0.7: fcl::collide and fcl::distance of BVHModel<OBBRSS>",
               .origin = Origin::peer},
      .tasks = {ConcaveTask::intersect, ConcaveTask::distance, ConcaveTask::contacts},
      .scalars = {Precision::float64},
      .supports = [](const ConcaveBody& a,
                     const ConcaveBody& b) { return !a.has_inside() && !b.has_inside(); },
      .approximate = true,
      .make = make_obbrss};
  std::vector<ConcaveEntry> entries = {entry};
  entry.tasks = {ConcaveTask::intersect, ConcaveTask::contacts};
  entry.info.name = "fcl-aabb";
  entry.info.citation = "FCL 0.7: fcl::collide of BVHModel<AABB>";
  entry.make = make_aabb;
  entries.push_back(entry);
  entry.info.name = "fcl-kdop16";
  entry.info.citation = "FCL 0.7: fcl::collide of BVHModel<KDOP<16>>";
  entry.make = make_kdop;
  entries.push_back(entry);
  return entries;
}

}  // namespace touchstone::entries

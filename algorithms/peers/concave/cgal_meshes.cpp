// CGAL: rigid meshes that are moved, and trees of boxes over their triangles.
// Paper:   Loriot, Rouxel-Labbe, "Collision detection of rigid triangle meshes", CGAL 5.5,
//          Rigid_triangle_mesh_collision_detection; Alliez, Tayeb, Wormser, AABB_tree, for lists of pairs.
//          CGAL is under the GNU General Public License, and so is a program with this file in it;
//          TOUCHSTONE_WITH_CGAL=OFF leaves it out.
// Departs: lists of pairs come of one query of a's tree for each triangle of b. Degenerate triangles, which
//          CGAL does not allow, are left out. Of solid meshes inclusions are asked too. Poses are relative to
//          the first body's origin, subtracted in double. CGAL takes surfaces on which each edge has at most two triangles; a mesh with
//          others is `unsupported`.
// Fails:   predicates are exact, but vertices are moved in doubles: touches through a rotation are those of
//          rounded bodies.
// Cost:    a binary tree for each mesh; intervals with fewer roundings at first, exact numbers behind.
#include "algorithms/concave_phase.h"
#ifdef TOUCHSTONE_HAS_CGAL
#include <CGAL/Rigid_triangle_mesh_collision_detection.h>
#include <CGAL/Surface_mesh.h>

#include <array>

#include "algorithms/peers/cgal_trees.h"

namespace touchstone {
namespace {

using namespace cgal;
using Surface = CGAL::Surface_mesh<Point>;

Kernel::Aff_transformation_3 to_cgal(const Pose& pose) {
  const auto& r = pose.rotation;
  const auto& t = pose.translation;
  return {r(0, 0), r(0, 1), r(0, 2), t[0],  //
          r(1, 0), r(1, 1), r(1, 2), t[1],  //
          r(2, 0), r(2, 1), r(2, 2), t[2]};
}

class CgalMeshes final : public ConcavePhase {
 public:
  void bind(std::span<const ConcaveBody> bodies) override {
    collision_ = {};
    bodies_.clear();
    for (const ConcaveBody& body : bodies) {
      Body& made = *bodies_.emplace_back(std::make_unique<Body>());
      if (body.mesh) add(*body.mesh, made);
    }
  }

  void solve(ConcaveTask task, const PlacedConcave& a, const PlacedConcave& b, Outcome& outcome,
             std::vector<IndexPair>& pairs) override {
    pairs.clear();
    Body &first = *bodies_[a.body], &second = *bodies_[b.body];
    if (!first.valid || !second.valid) {
      outcome.status = Status::unsupported;
      outcome.answer = Answer::unknown;
      return;
    }
    outcome.status = Status::not_reported;
    outcome.answer = Answer::separated;
    if (first.triangles.empty() || second.triangles.empty()) return;
    if (task == ConcaveTask::contacts) list_pairs(first, a.pose, second, b.pose, pairs);
    if (!pairs.empty() || meet(a, b)) outcome.answer = Answer::overlapping;
  }

 private:
  struct Body {
    bool valid = true, solid = false;
    Surface surface;
    Triangles triangles;
    std::vector<std::uint32_t> numbers;  // of the triangles, in the mesh
    std::unique_ptr<Tree> tree;
    std::array<std::size_t, 2> ids = {};  // in `collision_`, as the first and as the second body
  };

  void add(const TriangleMesh& mesh, Body& body) {
    body.solid = mesh.solid;
    std::vector<Surface::Vertex_index> vertices;
    for (const Vec3d& v : mesh.vertices) vertices.push_back(body.surface.add_vertex(to_point(v)));
    for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
      const auto& [a, b, c] = mesh.triangles[k];
      const Kernel::Triangle_3 triangle(to_point(mesh.vertices[a]), to_point(mesh.vertices[b]),
                                        to_point(mesh.vertices[c]));
      if (triangle.is_degenerate()) continue;
      body.triangles.push_back(triangle);
      body.numbers.push_back(k);
      const auto face = body.surface.add_face(vertices[a], vertices[b], vertices[c]);
      if (face == Surface::null_face()) body.valid = false;
    }
    if (!body.valid || body.triangles.empty()) return;
    body.tree = std::make_unique<Tree>(body.triangles.begin(), body.triangles.end());
    body.tree->build();
    for (std::size_t& id : body.ids) id = collision_.add_mesh(body.surface);
  }

  bool meet(const PlacedConcave& a, const PlacedConcave& b) {
    const Body &first = *bodies_[a.body], &second = *bodies_[b.body];
    const std::size_t id = first.ids[0];
    const std::array<std::size_t, 1> other = {second.ids[1]};
    const Vec3d offset = b.pose.translation - a.pose.translation;
    collision_.set_transformation(id, to_cgal(Pose{a.pose.rotation, Vec3d::Zero()}));
    collision_.set_transformation(other[0], to_cgal(Pose{b.pose.rotation, offset}));
    if (first.solid || second.solid) {
      return !collision_.get_all_intersections_and_inclusions(id, other).empty();
    }
    return !collision_.get_all_intersections(id, other).empty();
  }

  // Moves each triangle of b into the frame of a.
  static void list_pairs(const Body& a, const Pose& pose_a, const Body& b, const Pose& pose_b,
                         std::vector<IndexPair>& pairs) {
    const Mat3d back = pose_a.rotation.inverse();
    const Pose to_a = {back * pose_b.rotation, back * (pose_b.translation - pose_a.translation)};
    const Kernel::Aff_transformation_3 transformation = to_cgal(to_a);
    std::vector<Tree::Primitive_id> found;
    for (std::size_t k = 0; k < b.triangles.size(); ++k) {
      found.clear();
      a.tree->all_intersected_primitives(b.triangles[k].transform(transformation),
                                         std::back_inserter(found));
      for (const Tree::Primitive_id& id : found) {
        pairs.push_back(
            {a.numbers[static_cast<std::size_t>(id - a.triangles.begin())], b.numbers[k]});
      }
    }
  }

  std::vector<std::unique_ptr<Body>> bodies_;
  CGAL::Rigid_triangle_mesh_collision_detection<Surface> collision_;
};

std::unique_ptr<ConcavePhase> make_meshes(const ConcaveSettings&) {
  return std::make_unique<CgalMeshes>();
}

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<ConcaveEntry> peers_cgal_meshes() {
  return {
      {.info = {.name = "cgal-rigid-meshes",
                .citation = "CGAL 5.5, Rigid_triangle_mesh_collision_detection; AABB_tree",
                .origin = Origin::peer,
                .known_defect = "leaves out degenerate triangles; vertices are moved in doubles"},
       .tasks = {ConcaveTask::intersect, ConcaveTask::contacts},
       .scalars = {Precision::float64},
       .supports = [](const ConcaveBody& a,
                      const ConcaveBody& b) { return a.mesh != nullptr && b.mesh != nullptr; },
       .approximate = true,
       .make = make_meshes}};
}

}  // namespace touchstone::entries

// ODE's trimeshes against each other, and against spheres, capsules, boxes and planes.
// Paper:   Terdiman, "Memory-optimized bounding-volume hierarchies", 2001 (OPCODE); ODE 0.16, dCollide.
// Departs: one contact is asked for, with CONTACTS_UNIMPORTANT. ODE merges contacts, so that it has no list
//          of pairs. OPCODE fails with a mesh of one triangle, so a degenerate one far beyond the mesh is
//          added. A mesh never meets itself as one geom, so each body has two. Parts are asked one after
//          the other. Poses are relative to the first body's origin, subtracted in double.
// Fails:   the tree holds floats. Half of the touches of edges, vertices and coplanar triangles are missed,
//          and a sphere whose centre is behind a triangle. Two deep meshes are walked whole although one
//          contact is enough.
// Cost:    a tree of oriented boxes without scale, quantised.
#include "algorithms/concave_phase.h"

#include <algorithm>
#ifdef TOUCHSTONE_HAS_ODE
#include "algorithms/peers/ode_library.h"

namespace touchstone {
namespace {

struct DestroyTriangles {
  void operator()(dTriMeshDataID data) const {
    const auto lock = ode::enter();
    dGeomTriMeshDataDestroy(data);
  }
};
using Triangles = std::unique_ptr<std::remove_pointer_t<dTriMeshDataID>, DestroyTriangles>;

// The arrays that ODE reads, and what it makes of them.
struct Surface {
  std::vector<float> vertices;
  std::vector<dTriIndex> corners;
  Triangles data;

  explicit Surface(const TriangleMesh& mesh) {
    float far = 1;
    for (const Vec3d& v : mesh.vertices) {
      for (const double x : v) {
        vertices.push_back(static_cast<float>(x));
        far = std::max(far, 16 * std::abs(vertices.back()));
      }
    }
    for (const auto& triangle : mesh.triangles) {
      corners.insert(corners.end(), triangle.begin(), triangle.end());
    }
    if (mesh.triangles.size() == 1) {
      vertices.insert(vertices.end(), 3, far);
      corners.insert(corners.end(), 3, static_cast<dTriIndex>(mesh.vertices.size()));
    }
    data.reset(dGeomTriMeshDataCreate());
    dGeomTriMeshDataBuildSingle(data.get(), vertices.data(), 3 * sizeof(float),
                                static_cast<int>(vertices.size() / 3), corners.data(),
                                static_cast<int>(corners.size()), 3 * sizeof(dTriIndex));
  }
};

class OdeMeshes final : public ConcavePhase {
 public:
  void bind(std::span<const ConcaveBody> bodies) override {
    // What was bound before takes the lock as it goes.
    bodies_.clear();
    surfaces_.clear();
    const auto lock = ode::enter();
    for (const ConcaveBody& body : bodies) {
      Parts& parts = bodies_.emplace_back();
      if (body.mesh && !body.mesh->triangles.empty()) {
        const Surface& surface = *surfaces_.emplace_back(std::make_unique<Surface>(*body.mesh));
        Part& part = parts.emplace_back();
        part.shape.kind = ShapeKind::box;
        for (ode::Geom& geom : part.geoms) {
          geom.reset(dCreateTriMesh(nullptr, surface.data.get(), nullptr, nullptr, nullptr));
        }
      }
      for (const ConvexPart& convex : body.parts) {
        Part& part = parts.emplace_back();
        part.shape = convex.shape;
        part.pose = convex.pose;
        for (ode::Geom& geom : part.geoms) geom = ode::make_geom(convex.shape);
      }
    }
  }

  void solve(ConcaveTask, const PlacedConcave& a, const PlacedConcave& b, Outcome& outcome,
             std::vector<IndexPair>& pairs) override {
    pairs.clear();
    outcome.status = Status::not_reported;
    outcome.answer = Answer::separated;
    const Vec3d& origin = a.pose.translation;
    for (const Part& p : bodies_[a.body]) {
      p.place(0, a.pose, origin);
      for (const Part& q : bodies_[b.body]) {
        q.place(1, b.pose, origin);
        dContactGeom contact;
        constexpr int flags = 1 | static_cast<int>(CONTACTS_UNIMPORTANT);
        if (dCollide(p.geoms[0].get(), q.geoms[1].get(), flags, &contact, sizeof contact) == 0)
          continue;
        outcome.answer = Answer::overlapping;
        return;
      }
    }
  }

 private:
  struct Part {
    Shape shape;  // of a mesh only the kind counts, which makes its geom turn
    Pose pose;
    std::array<ode::Geom, 2> geoms;

    void place(std::size_t side, const Pose& body, const Vec3d& origin) const {
      const Pose placed = {body.rotation * pose.rotation,
                           (body.translation - origin) + body.rotation * pose.translation};
      ode::place(geoms[side].get(), shape, placed);
    }
  };
  using Parts = std::vector<Part>;

  std::vector<std::unique_ptr<Surface>> surfaces_;  // these outlive the geoms made of them
  std::vector<Parts> bodies_;
};

std::unique_ptr<ConcavePhase> make_meshes(const ConcaveSettings&) {
  return std::make_unique<OdeMeshes>();
}

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {
namespace {

bool takes(const ConcaveBody& body) {
  if (body.has_inside()) return false;
  return std::ranges::all_of(body.parts, [](const ConvexPart& part) {
    return part.shape.kind <= ShapeKind::box || part.shape.kind == ShapeKind::halfspace;
  });
}

}  // namespace

std::vector<ConcaveEntry> peers_ode_meshes() {
  return {
      {.info = {.name = "ode-opcode",
                .citation = "ODE 0.16, dCollide of trimeshes (OPCODE, Terdiman 2001)",
                .origin = Origin::peer,
                .known_defect = "rounds in floats; misses half of the touches of edges and "
                                "vertices, and spheres with their centre behind a triangle"},
       .tasks = {ConcaveTask::intersect},
       .scalars = {Precision::float32},
       .supports = [](const ConcaveBody& a,
                      const ConcaveBody& b) { return takes(a) && takes(b) && (a.mesh || b.mesh); },
       .approximate = true,
       .make = make_meshes}};
}

}  // namespace touchstone::entries

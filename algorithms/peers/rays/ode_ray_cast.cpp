// ODE's collision of a ray with a triangle mesh, by OPCODE.
// Paper:   Terdiman, "Memory-optimized bounding-volume hierarchies", 2001 (OPCODE); ODE 0.16, dCollide of
//          dCreateRay and dCreateTriMesh.
// Departs: ODE's ray has a unit direction and a length. It ends at t_max, or behind the mesh's far
//          side if that is sooner. OPCODE fails with a mesh of one triangle, so a point far beyond the
//          mesh is added as a second one. `any` is dGeomRaySetFirstContact.
// Fails:   the tree holds floats, and rays slip through at edges and vertices. ODE gives neither u nor
//          v; those here are of its point.
// Cost:    O(log n) a ray where triangles are small.
#include "algorithms/ray_cast.h"
#ifdef TOUCHSTONE_HAS_ODE
#include <optional>

#include "algorithms/peers/ode_library.h"
#include "algorithms/peers/rays/segment_rays.h"

namespace touchstone {
namespace {

class OdeRayCast final : public RayCast {
 public:
  OdeRayCast() {
    const auto lock = ode::enter();
    ray_ = dCreateRay(nullptr, 1);
  }
  ~OdeRayCast() override {
    const auto lock = ode::enter();
    release();
    dGeomDestroy(ray_);
  }
  OdeRayCast(const OdeRayCast&) = delete;
  OdeRayCast& operator=(const OdeRayCast&) = delete;

  void bind(const TriangleMesh& mesh) override {
    const auto lock = ode::enter();
    release();
    mesh_ = &mesh;
    vertices_.clear();
    numbers_.clear();
    reach_.emplace(mesh);
    for (const Vec3d& v : mesh.vertices) {
      for (const double x : v) vertices_.push_back(static_cast<float>(x));
    }
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t k : triangle) numbers_.push_back(k);
    }
    if (mesh.triangles.empty()) return;
    if (mesh.triangles.size() == 1) {
      const Vec3d beyond = reach_->high + 8 * (reach_->high - reach_->low);
      for (const double x : beyond) vertices_.push_back(static_cast<float>(x));
      numbers_.insert(numbers_.end(), 3, static_cast<dTriIndex>(mesh.vertices.size()));
    }
    data_ = dGeomTriMeshDataCreate();
    dGeomTriMeshDataBuildSingle(data_, vertices_.data(), 3 * sizeof(float),
                                static_cast<int>(vertices_.size() / 3), numbers_.data(),
                                static_cast<int>(numbers_.size()), 3 * sizeof(dTriIndex));
    body_ = dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
  }

  void cast(RayTask task, std::span<const Ray> rays, std::span<RayHit> hits) override {
    const auto lock = ode::enter();
    dGeomRaySetClosestHit(ray_, task == RayTask::closest ? 1 : 0);
    dGeomRaySetFirstContact(ray_, task == RayTask::any ? 1 : 0);
    dGeomRaySetBackfaceCull(ray_, 0);
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = hit_of(rays[i]);
  }

 private:
  void release() {
    if (body_ != nullptr) dGeomDestroy(body_);
    if (data_ != nullptr) dGeomTriMeshDataDestroy(data_);
    body_ = nullptr;
    data_ = nullptr;
  }

  RayHit hit_of(const Ray& ray) const {
    RayHit hit;
    hit.status = Status::not_reported;
    if (body_ == nullptr) return hit;
    const double length = ray.direction.norm();
    const double end = reach_->end(ray) * length;
    const auto& o = ray.origin;
    const Vec3d d = ray.direction / length;
    dGeomRaySet(ray_, static_cast<dReal>(o[0]), static_cast<dReal>(o[1]), static_cast<dReal>(o[2]),
                static_cast<dReal>(d[0]), static_cast<dReal>(d[1]), static_cast<dReal>(d[2]));
    dGeomRaySetLength(ray_, static_cast<dReal>(end));
    dContactGeom contact;
    if (dCollide(ray_, body_, 1, &contact, sizeof contact) == 0) return hit;
    hit.hit = true;
    hit.t = static_cast<double>(contact.depth) / length;
    if (contact.side2 < 0 || static_cast<std::size_t>(contact.side2) >= mesh_->triangles.size()) {
      return hit;
    }
    hit.triangle = static_cast<std::uint32_t>(contact.side2);
    set_weights(*mesh_, ray, hit);
    return hit;
  }

  const TriangleMesh* mesh_ = nullptr;
  std::optional<RayReach> reach_;
  std::vector<float> vertices_;
  std::vector<dTriIndex> numbers_;
  dGeomID ray_ = nullptr, body_ = nullptr;
  dTriMeshDataID data_ = nullptr;
};

std::unique_ptr<RayCast> make_cast(const RayCastSettings&) {
  return std::make_unique<OdeRayCast>();
}

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<RayCastEntry> peers_ode_ray_cast() {
  return {{.info = {.name = "ode-trimesh",
                    .citation = "ODE 0.16, dCollide of a ray and a trimesh (OPCODE, Terdiman 2001)",
                    .origin = Origin::peer,
                    .known_defect = "rounds in floats; rays slip through at edges and vertices; "
                                    "misses degenerate triangles and triangles seen edge-on"},
           .tasks = {RayTask::closest, RayTask::any},
           .scalars = {Precision::float32},
           .make = make_cast}};
}

}  // namespace touchstone::entries

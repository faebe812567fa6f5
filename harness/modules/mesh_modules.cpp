// Ray casts, point queries and concave phases of a module.
#include "algorithms/registry.h"
#include "harness/modules/layouts.h"
#include "harness/modules/module_sink.h"
#include "harness/modules/table.h"

namespace touchstone::modules {
namespace {

TouchstoneModuleMesh mesh_of(const TriangleMesh& mesh) {
  return {.struct_size = sizeof(TouchstoneModuleMesh),
          .solid = mesh.solid ? 1u : 0u,
          .vertices = mesh.vertices.empty() ? nullptr : mesh.vertices.front().data(),
          .triangles = mesh.triangles.empty() ? nullptr : mesh.triangles.front().data(),
          .vertex_count = mesh.vertices.size(),
          .triangle_count = mesh.triangles.size()};
}

// Throws process::Garbage if a triangle is none of so many, and not `none`.
void expect_triangle(std::uint32_t triangle, std::size_t count, const std::string& name) {
  if (triangle < count || triangle == TOUCHSTONE_MODULE_NO_TRIANGLE) return;
  throw process::Garbage(
      fmt::format("{}: found triangle {}; expected one below {}, or none", name, triangle, count));
}

class RayModule final : public RayCast {
 public:
  RayModule(const Offer<TouchstoneModuleRays>& offer, const RayCastSettings& settings)
      : instance_(offer,
                  TouchstoneModuleRaySettings{.struct_size = sizeof(TouchstoneModuleRaySettings),
                                              .scalar = scalar_of(settings.scalar)}) {}

  void bind(const TriangleMesh& mesh) override {
    const TouchstoneModuleMesh bound = mesh_of(mesh);
    mesh_ = bound;
    instance_.table().bind(instance_.made(), &mesh_);
  }

  void cast(RayTask task, std::span<const Ray> rays, std::span<RayHit> hits) override {
    instance_.table().cast(instance_.made(), bit_of(task), theirs(rays.data()), rays.size(),
                           theirs(hits.data()));
    expect_known(hits.data(), rays.size(), 1, most_status, instance_.name());
    for (const RayHit& hit : hits.first(rays.size())) {
      expect_triangle(hit.triangle, mesh_.triangle_count, instance_.name());
    }
  }

 private:
  TouchstoneModuleMesh mesh_{};  // outlives the instance
  Instance<TouchstoneModuleRays> instance_;
};

class PointModule final : public PointQuery {
 public:
  explicit PointModule(const Offer<TouchstoneModulePoints>& offer)
      : instance_(offer,
                  TouchstoneModulePointSettings{
                      .struct_size = sizeof(TouchstoneModulePointSettings), .reserved = 0}) {}

  void bind(const TriangleMesh& mesh) override {
    mesh_ = mesh_of(mesh);
    instance_.table().bind(instance_.made(), &mesh_);
  }

  void query(PointTask task, std::span<const Vec3d> points,
             std::span<PointAnswer> answers) override {
    if (points.empty()) return;
    instance_.table().query(instance_.made(), bit_of(task), points.front().data(), points.size(),
                            theirs(answers.data()));
    expect_known(answers.data(), points.size(), most_status, TOUCHSTONE_MODULE_SIDE_UNKNOWN,
                 instance_.name());
    for (const PointAnswer& answer : answers.first(points.size())) {
      expect_triangle(answer.triangle, mesh_.triangle_count, instance_.name());
    }
  }

 private:
  TouchstoneModuleMesh mesh_{};
  Instance<TouchstoneModulePoints> instance_;
};

class MeshModule final : public ConcavePhase {
 public:
  MeshModule(const Offer<TouchstoneModuleMeshes>& offer, const ConcaveSettings& settings)
      : instance_(offer,
                  TouchstoneModuleMeshSettings{.struct_size = sizeof(TouchstoneModuleMeshSettings),
                                               .scalar = scalar_of(settings.scalar)}) {}

  // Bodies without a mesh are bound as empty meshes, and never asked about.
  void bind(std::span<const ConcaveBody> bodies) override {
    const TriangleMesh no_mesh;
    std::vector<TouchstoneModuleMesh> meshes;
    for (const ConcaveBody& body : bodies) {
      meshes.push_back(mesh_of(body.mesh ? *body.mesh : no_mesh));
    }
    std::vector<const TouchstoneModuleMesh*> pointers;
    for (const TouchstoneModuleMesh& mesh : meshes) pointers.push_back(&mesh);
    instance_.table().bind(instance_.made(), pointers.data(), pointers.size());
    meshes_.swap(meshes);
    pointers_.swap(pointers);
  }

  void solve(ConcaveTask task, const PlacedConcave& a, const PlacedConcave& b, Outcome& outcome,
             std::vector<IndexPair>& pairs) override {
    buffer_.clear();
    ModuleSink sink(buffer_);
    instance_.table().solve(instance_.made(), bit_of(task), a.body, theirs(&a.pose), b.body,
                            theirs(&b.pose), theirs(&outcome), sink.get());
    sink.finish(instance_.name());
    expect_known(&outcome, 1, TOUCHSTONE_MODULE_UNKNOWN, most_status, instance_.name());
    for (const IndexPair& pair : buffer_.pairs()) {
      if (pair.a < meshes_[a.body].triangle_count && pair.b < meshes_[b.body].triangle_count)
        continue;
      throw process::Garbage(
          fmt::format("{}: found the pair of triangles {} and {}; expected them "
                      "below {} and {}",
                      instance_.name(), pair.a, pair.b, meshes_[a.body].triangle_count,
                      meshes_[b.body].triangle_count));
    }
    pairs.assign(buffer_.pairs().begin(), buffer_.pairs().end());
  }

 private:
  PairBuffer buffer_;
  std::vector<TouchstoneModuleMesh> meshes_;
  std::vector<const TouchstoneModuleMesh*> pointers_;
  Instance<TouchstoneModuleMeshes> instance_;
};

bool are_meshes(const ConcaveBody& a, const ConcaveBody& b) { return a.mesh && b.mesh; }
bool are_surfaces(const ConcaveBody& a, const ConcaveBody& b) {
  return are_meshes(a, b) && !a.mesh->solid && !b.mesh->solid;
}

}  // namespace

void add(Offer<TouchstoneModuleRays> offer, AlgorithmInfo info, TrialAnswers&) {
  const TouchstoneModuleRays& table = offer->table;
  expect_functions(*offer, {{"bind", table.bind != nullptr}, {"cast", table.cast != nullptr}});
  expect_bits(*offer, "tasks", table.tasks, 0b11);
  expect_bits(*offer, "scalars", table.scalars, all_scalars);
  registry::add(RayCastEntry{.info = std::move(info),
                             .tasks = values_of<RayTask>(table.tasks),
                             .scalars = scalars_of(table.scalars),
                             .make =
                                 [offer](const RayCastSettings& settings) {
                                   return std::make_unique<RayModule>(offer, settings);
                                 }},
                registry::Timed::yes, offer->object->file().string());
}

void add(Offer<TouchstoneModulePoints> offer, AlgorithmInfo info, TrialAnswers&) {
  const TouchstoneModulePoints& table = offer->table;
  expect_functions(*offer, {{"bind", table.bind != nullptr}, {"query", table.query != nullptr}});
  expect_bits(*offer, "tasks", table.tasks, 0b11);
  expect_bits(*offer, "scalar", table.scalar, all_scalars);
  registry::add(PointQueryEntry{.info = std::move(info),
                                .tasks = values_of<PointTask>(table.tasks),
                                .scalar = scalars_of(table.scalar).front(),
                                .make = [offer] { return std::make_unique<PointModule>(offer); }},
                registry::Timed::yes, offer->object->file().string());
}

void add(Offer<TouchstoneModuleMeshes> offer, AlgorithmInfo info, TrialAnswers&) {
  const TouchstoneModuleMeshes& table = offer->table;
  expect_functions(*offer, {{"bind", table.bind != nullptr}, {"solve", table.solve != nullptr}});
  expect_bits(*offer, "tasks", table.tasks, 0b111);
  expect_bits(*offer, "scalars", table.scalars, all_scalars);
  registry::add(ConcaveEntry{.info = std::move(info),
                             .tasks = values_of<ConcaveTask>(table.tasks),
                             .scalars = scalars_of(table.scalars),
                             .supports = table.takes_solid != 0 ? are_meshes : are_surfaces,
                             .make =
                                 [offer](const ConcaveSettings& settings) {
                                   return std::make_unique<MeshModule>(offer, settings);
                                 }},
                registry::Timed::yes, offer->object->file().string());
}

}  // namespace touchstone::modules

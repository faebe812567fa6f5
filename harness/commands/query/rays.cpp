// touchstone rays: casts rays at a mesh or a scene, and writes a row for each answer.
#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/core/nearest_float.h"
#include "algorithms/oracle/certificates/parts/mesh_certificate_check.h"
#include "algorithms/oracle/certificates/parts/scene_ray_check.h"
#include "algorithms/oracle/rays/exact_mesh_proofs.h"
#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/query/proofs.h"
#include "harness/commands/query/query_rows.h"
#include "harness/commands/query/rays_files.h"
#include "harness/commands/query/rays_of_scenes.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/files/output_file.h"
#include "harness/files/proofs/mesh_certificates.h"
#include "harness/geometry/mesh.h"
#include "harness/kinds/selection.h"
#include "harness/process/isolate.h"

namespace touchstone::commands {
namespace {

// The hits of one algorithm, one for each ray.
struct Cast {
  const RayCastEntry* entry;
  std::vector<RayHit> hits;
};

// Casts all rays, in a child process. Prints the failures.
Cast ask(const RayCastEntry& entry, const TriangleMesh& mesh, const std::vector<Ray>& rays,
         const RaysOptions& options) {
  Cast cast = {&entry, std::vector<RayHit>(rays.size())};
  if (!offers(entry, options.task) || !offers(entry, options.settings.scalar)) return cast;
  auto solved =
      process::isolated_answers<RayHit>(rays.size(), {.item_seconds = options.time_limit}, [&] {
        std::shared_ptr<RayCast> caster = entry.make(options.settings);
        caster->bind(mesh);
        return [&rays, &options, caster](std::size_t item) {
          RayHit hit;
          caster->cast(options.task, {&rays[item], 1}, {&hit, 1});
          return hit;
        };
      });
  cast.hits = std::move(solved.answers);
  print_failures(entry.info.name, solved.failures, name_of_ray);
  return cast;
}

void write_row(files::CsvWriter& csv, std::size_t ray, const Cast& cast, Precision scalar) {
  const RayHit& hit = cast.hits[ray];
  csv.field(ray).field(cast.entry->info.name).field(to_string(scalar));
  csv.field(hit.hit ? 1 : 0).field(hit.t);
  if (hit.triangle == RayHit::no_triangle) {
    csv.field("");
  } else {
    csv.field(static_cast<std::int64_t>(hit.triangle));
  }
  csv.field(hit.u).field(hit.v).field(to_string(hit.status));
  csv.end_row();
}

// Proves the exact answer for each ray.
void save_ray_proofs(TriangleMesh mesh, const std::vector<Ray>& rays, const RaysOptions& options) {
  const auto rounded = [&](const Vec3d& v) {
    return options.settings.scalar == Precision::float64 ? v : nearest_float(v);
  };
  for (Vec3d& vertex : mesh.vertices) vertex = rounded(vertex);
  SavedCertificates saved(options.saved);
  saved.head(files::mesh_line(mesh));
  const auto setup = [&] {
    return [&, prover = std::make_shared<oracle::MeshProver>(mesh)](
               std::size_t i) -> std::optional<std::string> {
      Ray ray = {rounded(rays[i].origin), rounded(rays[i].direction), rays[i].t_max};
      if (options.settings.scalar == Precision::float32) ray.t_max = nearest_float(ray.t_max);
      const auto certificate =
          prover->prove_ray(ray.origin, ray.direction, ray.t_max, options.task == RayTask::closest);
      if (!certificate) return {};
      return files::to_json(files::StoredRayCertificate{i, *certificate});
    };
  };
  saved.add_each(rays.size(), options.time_limit, setup, name_of_ray);
  saved.close();
}

// True if the certificate is of the ray, or of that which is nearest to it in float.
template <class Certificate>
bool is_of(const Certificate& certificate, const Ray& ray) {
  const auto is_equal = [&](const Vec3d& origin, const Vec3d& direction, double t_max) {
    return certificate.origin == origin && certificate.direction == direction &&
           certificate.t_max == t_max;
  };
  return is_equal(ray.origin, ray.direction, ray.t_max) ||
         is_equal(nearest_float(ray.origin), nearest_float(ray.direction),
                  nearest_float(ray.t_max));
}

int verify_ray_proofs(const RaysOptions& options) {
  const std::vector<Ray> rays = options.rays.empty() ? std::vector<Ray>{} : read_rays(options.rays);
  Verdicts verdicts(options.certificates);
  QuestionNumbers numbers;
  const auto add = [&](const auto& stored, std::int64_t line, auto& target) {
    std::string why = numbers.fault(stored.ray);
    if (why.empty() && !options.rays.empty() &&
        (stored.ray >= rays.size() || !is_of(stored.certificate, rays[stored.ray]))) {
      why = "--rays has another ray of that number, or none";
    }
    if (why.empty()) why = target->fault(stored.certificate);
    verdicts.add(line, name_of_ray(stored.ray), why);
    return why.empty();
  };
  std::optional<oracle::CheckedMesh> mesh;
  std::vector<files::PlacedConcave> bodies;
  std::optional<oracle::CheckedScene> scene;
  const files::RayTargets targets = {
      .mesh =
          [&](const TriangleMesh& read) {
            numbers.begin();
            mesh.emplace(read);
          },
      .at_mesh = [&](const files::StoredRayCertificate& stored,
                     std::int64_t line) { add(stored, line, mesh); },
      .scene =
          [&](std::vector<files::PlacedConcave> read) {
            numbers.begin();
            bodies = std::move(read);
            std::vector<oracle::PlacedBody> placed;
            for (const auto& [body, pose] : bodies) placed.push_back({body, pose});
            scene.emplace(std::move(placed));
          },
      .at_scene =
          [&](const files::StoredSceneRayCertificate& stored, std::int64_t line) {
            if (add(stored, line, scene) && !stored.certificate.is_ordered) {
              verdicts.add_without_order();
            }
          }};
  return verdicts.of([&] { files::read_ray_certificates(options.certificates, targets); });
}

void cast_rays(const RaysOptions& options) {
  const auto entries = kinds::select(registry::entries<RayCastEntry>(),
                                     kinds::split_names(options.cast), "ray cast");
  geometry::Mesh read = geometry::read_surface(options.target);
  tell_extent(options.target, read.vertices);
  const TriangleMesh mesh{std::move(read.vertices), std::move(read.triangles)};
  const std::vector<Ray> rays = read_rays(options.rays);
  files::check_outputs({{"FILE", options.target}, {"--rays", options.rays}},
                       {{"--out", options.out}, {"--save-certificates", options.saved}});
  std::vector<Cast> casts;
  casts.reserve(entries.size());
  for (const RayCastEntry* entry : entries) casts.push_back(ask(*entry, mesh, rays, options));
  files::CsvWriter csv(options.out,
                       {"ray", "algorithm", "scalar", "hit", "t", "triangle", "u", "v", "status"});
  for (std::size_t ray = 0; ray < rays.size(); ++ray) {
    for (const Cast& cast : casts) write_row(csv, ray, cast, options.settings.scalar);
  }
  csv.close();
  std::vector<RaysSummary> summaries;
  for (const Cast& cast : casts) {
    RaysSummary& summary = summaries.emplace_back();
    summary.name = cast.entry->info.name;
    for (const RayHit& hit : cast.hits) summary.add(hit.hit, hit.status);
  }
  print_summaries(summaries);
  std::vector<std::string> of_other;
  for (const RayCastEntry* entry : entries) {
    if (is_built(entry->info) && !offers(*entry, options.settings.scalar)) {
      of_other.push_back(entry->info.name);
    }
  }
  print_scalar_hint(of_other, options.settings.scalar);
  if (!options.saved.empty()) save_ray_proofs(mesh, rays, options);
}

void cast_rays_at_target(RaysOptions& options) {
  expect_without_certificates(options.target, "FILE");
  expect_without_certificates(options.rays, "--rays");
  expect_without_certificates(options.cast, "--cast");
  expect_without_certificates(options.asked ? "given" : "", "--task");
  expect_without_certificates(options.out, "--out");
  options.task = *options.asked;
  if (is_scene(options.target)) return cast_rays_at_scene(options);
  if (options.frame != 0) throw base::InputError("--frame: a mesh has no frames");
  cast_rays(options);
}

}  // namespace

void add_rays(Arguments command) {
  static const Arguments::Choices<RayTask> tasks = {{"closest", RayTask::closest},
                                                    {"any", RayTask::any}};
  const auto options = std::make_shared<RaysOptions>();
  command.text(
      "FILE", options->target,
      "A mesh (OBJ, OFF, STL or PLY; a face of more corners becomes a fan of triangles around "
      "its first, which is right for convex faces), or a scene (TOML, or rigid-ipc's JSON)");
  command.text("--rays", options->rays, "Rays: CSV with origin, direction and t_max (required)");
  command.text("--cast", options->cast, "Ray casts: names joined by commas, or all (required)");
  command.one_of("--task", options->asked, tasks,
                 "The first hit, or whether there is any (required)");
  command.one_of("--scalar", options->settings.scalar, scalar_choices(), "What the input is")
      .show_default("double");
  command.number("--frame", options->frame, "Which frame of a scene").show_default();
  add_time_limit(command, options->time_limit, "Seconds that a ray may take, and its proof")
      .show_default();
  command.text("--out", options->out, "The CSV file to write (required)");
  command.text("--save-certificates", options->saved,
               "Also prove the exact answer for each ray, and write the proofs to this file");
  command.text(
      "--certificates", options->certificates,
      "Only verify the proofs in this file, and with --rays that each is of the ray of its "
      "number");
  command.exclude_others("--certificates", {"--rays"});
  command.job([options]() -> int {
    if (!options->certificates.empty()) return verify_ray_proofs(*options);
    cast_rays_at_target(*options);
    return exit_done;
  });
}

}  // namespace touchstone::commands

// Rays at a scene's bodies: the scene with `exact` and others, each in a child process.
#include "harness/commands/query/rays_of_scenes.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "algorithms/oracle/rays/exact_scene_ray_proofs.h"
#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/commands/query/proofs.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/files/output_file.h"
#include "harness/files/proofs/scene_ray_certificates.h"
#include "harness/kinds/selection.h"
#include "harness/process/isolate.h"
#include "harness/scene/player.h"

namespace touchstone::commands {
namespace {

// The scene's bodies at a frame.
std::vector<SceneBody> bodies_at(const scene::Scene& scene, int frame, const std::string& file) {
  if (!scene.recording.empty()) {
    throw base::InputError(fmt::format("{}: a recording has no bodies that rays could hit", file));
  }
  if (frame < 0 || frame >= scene.frames) {
    throw base::InputError(
        fmt::format("--frame {}: {} has frames 0 to {}", frame, file, scene.frames - 1));
  }
  scene::ScenePlayer player(scene, scene::BoxKind::tight);
  while (player.frame() < frame) player.next();
  std::vector<SceneBody> bodies(scene.bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    // A body that is not present has the empty box, and no parts.
    if (i >= player.boxes().size() || player.boxes()[i].is_empty()) continue;
    const std::uint32_t shape = scene.bodies[i].shape;
    if (const ConcaveBody* concave = scene.concave_of(shape)) {
      bodies[i].body = *concave;
    } else {
      bodies[i].body.parts.push_back({.shape = scene.shapes[shape], .pose = {}});
    }
    bodies[i].pose = player.poses()[i];
  }
  return bodies;
}

// The hits of one algorithm, one for each ray.
struct SceneCast {
  const SceneRayCastEntry* entry;
  std::vector<SceneRayHit> hits;
};

SceneCast ask_at_scene(const SceneRayCastEntry& entry, const std::vector<SceneBody>& bodies,
                       const std::vector<Ray>& rays, const RaysOptions& options) {
  auto solved = process::isolated_answers<SceneRayHit>(
      rays.size(), {.item_seconds = options.time_limit}, [&] {
        std::shared_ptr<SceneRayCast> caster = entry.make();
        caster->bind(bodies);
        return [&rays, &options, caster](std::size_t item) {
          SceneRayHit hit;
          caster->cast(options.task, {&rays[item], 1}, {&hit, 1});
          return hit;
        };
      });
  print_failures(entry.info.name, solved.failures, name_of_ray);
  return {&entry, std::move(solved.answers)};
}

void write_scene_row(files::CsvWriter& csv, const std::vector<SceneBody>& bodies, std::size_t ray,
                     const SceneCast& cast) {
  const SceneRayHit& hit = cast.hits[ray];
  csv.field(ray).field(cast.entry->info.name).field(to_string(Precision::float64));
  csv.field(hit.hit ? 1 : 0).field(hit.t);
  // A mesh's part is its triangle; where in it the hit lies is not told.
  if (hit.body != SceneRayHit::none && bodies[hit.body].body.mesh) {
    csv.field(static_cast<std::int64_t>(hit.part));
  } else {
    csv.field("");
  }
  csv.field("").field("").field(to_string(hit.status));
  for (const std::uint32_t number : {hit.body, hit.part}) {
    if (number == SceneRayHit::none) {
      csv.field("");
    } else {
      csv.field(static_cast<std::int64_t>(number));
    }
  }
  for (const double x : hit.normal) csv.field(x);
  csv.end_row();
}

// Proves the exact answer for each ray.
void save_scene_ray_proofs(const std::vector<SceneBody>& bodies, const std::vector<Ray>& rays,
                           const RaysOptions& options) {
  std::vector<files::PlacedConcave> named;
  std::vector<oracle::PlacedBody> placed;
  for (const auto& [body, pose] : bodies) {
    named.push_back({body, pose});
    placed.push_back({body, pose});
  }
  SavedCertificates saved(options.saved);
  saved.head(files::scene_line(named));
  const auto setup = [&] {
    return [&, prover = std::make_shared<oracle::SceneRayProver>(placed)](
               std::size_t i) -> std::optional<std::string> {
      const auto certificate = prover->prove(rays[i].origin, rays[i].direction, rays[i].t_max,
                                             options.task == RayTask::closest);
      if (!certificate) return {};
      return files::to_json(files::StoredSceneRayCertificate{i, *certificate});
    };
  };
  saved.add_each(rays.size(), options.time_limit, setup, name_of_ray);
  saved.close();
}

}  // namespace

bool is_scene(const std::string& file) {
  return file.ends_with(".toml") || file.ends_with(".json") || file.ends_with(".aabbs");
}

void cast_rays_at_scene(const RaysOptions& options) {
  if (options.settings.scalar != Precision::float64) {
    throw base::InputError("--scalar float: rays at scenes are cast in double alone");
  }
  const auto entries = kinds::select(registry::entries<SceneRayCastEntry>(),
                                     kinds::split_names(options.cast), "ray cast of scenes");
  const scene::Scene scene = scene::load_scene(options.target);
  const std::vector<SceneBody> bodies = bodies_at(scene, options.frame, options.target);
  const std::vector<Ray> rays = read_rays(options.rays);
  std::vector<files::NamedFile> inputs = scene.inputs();
  inputs.push_back({"--rays", options.rays});
  files::check_outputs(inputs, std::vector<files::NamedFile>{
                                   {"--out", options.out}, {"--save-certificates", options.saved}});
  std::vector<SceneCast> casts;
  casts.reserve(entries.size());
  for (const SceneRayCastEntry* entry : entries)
    casts.push_back(ask_at_scene(*entry, bodies, rays, options));
  files::CsvWriter csv(options.out, {"ray", "algorithm", "scalar", "hit", "t", "triangle", "u", "v",
                                     "status", "body", "part", "normal_x", "normal_y", "normal_z"});
  for (std::size_t ray = 0; ray < rays.size(); ++ray) {
    for (const SceneCast& cast : casts) write_scene_row(csv, bodies, ray, cast);
  }
  csv.close();
  std::vector<RaysSummary> summaries;
  for (const SceneCast& cast : casts) {
    RaysSummary& summary = summaries.emplace_back();
    summary.name = cast.entry->info.name;
    for (const SceneRayHit& hit : cast.hits) summary.add(hit.hit, hit.status);
  }
  print_summaries(summaries);
  if (!options.saved.empty()) save_scene_ray_proofs(bodies, rays, options);
}

}  // namespace touchstone::commands

// touchstone rays: casts rays at a mesh, and writes a row for each answer.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/campaign/selection.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/geometry/mesh.h"
#include "harness/process/isolate.h"

namespace touchstone::commands {
namespace {

struct RaysOptions {
  std::string mesh, rays, cast, out;
  RayTask task = RayTask::closest;
  RayCastSettings settings;
  double time_limit = 5;  // seconds a ray
};

// The hits of one algorithm, one for each ray.
struct Cast {
  const RayCastEntry* entry;
  std::vector<RayHit> hits;
};

std::vector<Ray> read_rays(const std::string& file) {
  std::vector<Ray> rays;
  const files::CsvReader reader(file, {"origin_x", "origin_y", "origin_z", "direction_x",
                                       "direction_y", "direction_z", "t_max"});
  reader.read([&](const files::CsvReader::Row& row) {
    const auto finite = [&](std::size_t column) {
      const double value = row.number(column);
      if (!std::isfinite(value)) {
        row.fail(fmt::format("column {}: found {}; expected a finite number", row.name(column),
                             row.text(column)));
      }
      return value;
    };
    Ray ray{{finite(0), finite(1), finite(2)}, {finite(3), finite(4), finite(5)}, row.number(6)};
    if (ray.direction.isZero(0)) row.fail("the direction is zero; expected one that is not");
    if (!(ray.t_max >= 0)) {
      row.fail(fmt::format("column t_max: found {}; expected 0 or more, or inf", row.text(6)));
    }
    rays.push_back(std::move(ray));
  });
  return rays;
}

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
  print_failures(entry.info.name, solved.failures,
                 [](std::size_t item) { return fmt::format("ray {}", item); });
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

// Prints the number of hits and of each status of every algorithm.
void print_summary(const std::vector<Cast>& casts) {
  fmt::print("{:<24} {:>9} {:>9}  {}\n", "algorithm", "hits", "misses", "status");
  for (const Cast& cast : casts) {
    std::size_t hits = 0;
    std::map<Status, std::size_t> statuses;
    for (const RayHit& hit : cast.hits) {
      hits += hit.hit ? 1 : 0;
      ++statuses[hit.status];
    }
    std::string text;
    for (const auto& [status, count] : statuses) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", to_string(status), count);
    }
    fmt::print("{:<24} {:>9} {:>9}  {}\n", cast.entry->info.name, hits, cast.hits.size() - hits,
               text);
  }
}

void cast_rays(const RaysOptions& options) {
  const auto entries =
      campaign::select(ray_casts(), campaign::split_names(options.cast), "ray cast");
  geometry::Mesh read = geometry::read_mesh(options.mesh);
  const TriangleMesh mesh{std::move(read.vertices), std::move(read.triangles)};
  const std::vector<Ray> rays = read_rays(options.rays);
  files::check_output(options.out);
  std::vector<Cast> casts;
  casts.reserve(entries.size());
  for (const RayCastEntry* entry : entries) casts.push_back(ask(*entry, mesh, rays, options));
  files::CsvWriter csv(options.out,
                       {"ray", "algorithm", "scalar", "hit", "t", "triangle", "u", "v", "status"});
  for (std::size_t ray = 0; ray < rays.size(); ++ray) {
    for (const Cast& cast : casts) write_row(csv, ray, cast, options.settings.scalar);
  }
  csv.close();
  print_summary(casts);
}

}  // namespace

void add_rays(Arguments command) {
  static const Arguments::Choices<RayTask> tasks = {{"closest", RayTask::closest},
                                                    {"any", RayTask::any}};
  const auto options = std::make_shared<RaysOptions>();
  command.text("MESH", options->mesh, "The mesh: OBJ, OFF, STL or PLY").required();
  command.text("--rays", options->rays, "Rays: CSV with origin, direction and t_max").required();
  command.text("--cast", options->cast, "Ray casts: names joined by commas, or all").required();
  command.one_of("--task", options->task, tasks, "The first hit, or whether there is any")
      .required();
  command.one_of("--scalar", options->settings.scalar, scalar_choices(), "What the input is")
      .show_default("double");
  add_time_limit(command, options->time_limit, "Seconds that a ray may take").show_default();
  command.text("--out", options->out, "The CSV file to write").required();
  command.job([options] {
    cast_rays(*options);
    return exit_done;
  });
}

}  // namespace touchstone::commands

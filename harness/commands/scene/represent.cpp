// touchstone scene represent: makes proxies of a scene's bodies, and measures their errors.
// The proxies come from coarse to fine.
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>

#include "harness/base/error.h"
#include "harness/base/table.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/proxies/representation.h"
#include "harness/scene/scene.h"

namespace touchstone::commands {
namespace {

struct RepresentOptions {
  std::string scene, out;
  std::vector<std::string> forms = {"sphere",  "box",     "oriented-box", "dop-14",
                                    "dop-18",  "dop-26",  "capsule",      "hull-8",
                                    "hull-16", "hull-32", "hull",         "parts"};
  std::string side = "outer";
  scene::SceneOverrides overrides;
};

std::vector<proxies::Representation> representations(const RepresentOptions& options) {
  std::vector<proxies::Representation> list;
  for (const std::string& form : options.forms) {
    proxies::Representation r = proxies::parse_representation(form);
    if (r.side != proxies::Side::outer) {
      throw base::InputError(
          fmt::format("--forms {}: expected forms without a side; --side inner or "
                      "--side nearest is for all of them",
                      form));
    }
    if (r.form != proxies::Form::as_given && r.form != proxies::Form::mesh) {
      r.side = options.side == "inner"     ? proxies::Side::inner
               : options.side == "nearest" ? proxies::Side::nearest
                                           : proxies::Side::outer;
    }
    list.push_back(r);
  }
  return list;
}

struct Measured {
  proxies::RepresentationError error;
  std::size_t parts = 0, vertices = 0;
  double seconds = 0;
  std::string words;  // the reason of a failure
};

// `is_convex` is false of a body for which the shape is only a hull around it.
Measured measure(const Shape& shape, const geometry::Mesh* mesh, bool is_convex,
                 const proxies::Representation& r) {
  Measured m;
  try {
    if (!is_convex && r.form == proxies::Form::as_given) {
      throw base::InputError(
          "as given, the body is not convex, and convex parts stand for it only in another form; "
          "expected hull, parts or mesh");
    }
    const auto start = std::chrono::steady_clock::now();
    const std::vector<proxies::Part> parts = proxies::represent(shape, mesh, r);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    m.seconds = time.count();
    m.parts = parts.size();
    for (const proxies::Part& part : parts) {
      if (part.shape.kind == ShapeKind::box) m.vertices += 8;
      if (part.shape.hull != nullptr) m.vertices += part.shape.hull->vertices.size();
    }
    m.error = proxies::representation_error(shape, mesh, parts);
  } catch (const base::InputError& none) {
    m.words = none.what();
  }
  return m;
}

// The errors of one representation over all shapes.
struct Summary {
  std::vector<double> volume, hausdorff;  // parts of the volume; parts of the size
  std::size_t missing = 0, flat = 0, parts = 0;
  double seconds = 0;
};

std::string shown(double value) { return fmt::format("{:.4g}", value); }

// Adds the mean, the 99th percentile and the greatest value.
void add_cells(std::vector<double> values, std::vector<std::string>& row) {
  if (values.empty()) {
    row.insert(row.end(), {"", "", ""});
    return;
  }
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (double v : values) sum += v;
  const double count = static_cast<double>(values.size());
  const auto rank = static_cast<std::size_t>(std::ceil(0.99 * count)) - 1;
  for (double v : {sum / count, values[rank], values.back()}) row.push_back(shown(v));
}

void print(const scene::Scene& scene, const std::vector<proxies::Representation>& list,
           const std::vector<Summary>& summaries) {
  base::Table table({"representation", "shapes", "none", "flat", "parts", "volume mean", "p99",
                     "greatest", "hausdorff mean", "p99", "greatest", "ms each"});
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Summary& s = summaries[i];
    const std::size_t made = s.hausdorff.size();
    std::vector<std::string> row = {to_string(list[i]), fmt::format("{}", made),
                                    fmt::format("{}", s.missing), fmt::format("{}", s.flat),
                                    fmt::format("{}", s.parts)};
    add_cells(s.volume, row);
    add_cells(s.hausdorff, row);
    row.push_back(made == 0 ? "" : shown(1e3 * s.seconds / static_cast<double>(made)));
    table.add(std::move(row));
  }
  fmt::print(
      "{}: volume (added and lost, as parts of the body's) and Hausdorff distance (as a part of "
      "the "
      "diameter of its bounding ball) of each shape\n\n{}",
      scene.name, table.text(base::page_width()));
}

// Returns false if a shape has none of a form.
bool run(const RepresentOptions& options) {
  const std::vector<proxies::Representation> list = representations(options);
  const scene::Scene scene = scene::load_scene(options.scene, options.overrides);
  files::check_outputs(scene.inputs(), std::vector<files::NamedFile>{{"--out", options.out}});
  std::map<std::uint32_t, std::size_t> bodies;
  for (const scene::Body& body : scene.bodies) ++bodies[body.shape];
  if (bodies.empty()) {
    throw base::InputError(options.scene, 0, "a recording of boxes; expected a scene with bodies");
  }
  files::CsvWriter csv(options.out,
                       {"scene", "shape", "kind", "bodies", "triangles", "form", "status", "added",
                        "lost", "volume_deviation", "hausdorff", "hausdorff_of_size",
                        "hausdorff_deviation", "size", "parts", "vertices", "seconds"});
  std::vector<Summary> summaries(list.size());
  for (const auto& [shape, users] : bodies) {
    const geometry::Mesh* mesh = scene.mesh_of(shape);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Shape& given = scene.shapes[shape];
      if (given.kind == ShapeKind::halfspace) continue;
      const Measured m = measure(given, mesh, scene.concave_of(shape) == nullptr, list[i]);
      const bool made = m.words.empty();
      csv.field(scene.name).field(static_cast<std::int64_t>(shape)).field(to_string(given.kind));
      csv.field(users);
      csv.field(mesh == nullptr ? std::size_t{0} : mesh->triangles.size());
      csv.field(to_string(list[i])).field(made ? "ok" : m.words);
      const double none = std::nan("");
      for (double value : {m.error.added, m.error.lost, m.error.volume_deviation, m.error.hausdorff,
                           m.error.size > 0 ? m.error.hausdorff / m.error.size : 0,
                           m.error.hausdorff_deviation, m.error.size}) {
        csv.field(made ? value : none);
      }
      csv.field(m.parts).field(m.vertices).field(made ? m.seconds : none);
      csv.end_row();
      Summary& s = summaries[i];
      if (!made) {
        ++s.missing;
        continue;
      }
      if (std::isfinite(m.error.volume_error())) {
        s.volume.push_back(m.error.volume_error());
      } else {
        ++s.flat;
      }
      s.hausdorff.push_back(m.error.size > 0 ? m.error.hausdorff / m.error.size : 0);
      s.parts += m.parts;
      s.seconds += m.seconds;
    }
  }
  csv.close();
  print(scene, list, summaries);
  return std::ranges::all_of(summaries, [](const Summary& s) { return s.missing == 0; });
}

}  // namespace

void add_scene_represent(Arguments command) {
  auto options = std::make_shared<RepresentOptions>();
  command.text("scene", options->scene, "Scene file: .toml, .urdf, rigid-ipc's .json or a model")
      .is_read()
      .required();
  command
      .texts("--forms", options->forms,
             "Of: as-given, sphere, box, oriented-box, dop-14, dop-18, dop-26, capsule, hull-K "
             "(at most K vertices, from 8), hull, parts, parts-K (at most K), mesh, icosphere-L "
             "(0 to 5)")
      .separated_by_commas()
      .show_default();
  command
      .text("--side", options->side,
            "outer: holds the body; inner: inside it; nearest: of the body's volume")
      .among({"outer", "inner", "nearest"})
      .show_default();
  command.text("--out", options->out, "One row for each shape and form (CSV)").required();
  add_scene_overrides(command, options->overrides);
  command.job([options] { return run(*options) ? exit_done : exit_measured_wrong; });
}

}  // namespace touchstone::commands

// touchstone points: asks for the closest point of a mesh, or the side of its surface, and writes a row
// for each answer.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/oracle/certificates/parts/mesh_certificate_check.h"
#include "algorithms/oracle/rays/exact_mesh_proofs.h"
#include "algorithms/registry.h"
#include "harness/base/file_text.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/query/proofs.h"
#include "harness/commands/query/query_rows.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/files/output_file.h"
#include "harness/files/proofs/mesh_certificates.h"
#include "harness/geometry/mesh.h"
#include "harness/geometry/shapes/compound.h"
#include "harness/kinds/selection.h"
#include "harness/process/isolate.h"

namespace touchstone::commands {
namespace {

struct PointsOptions {
  std::string mesh, points, query = "all", out;
  std::string saved, certificates;  // files of proofs; none if empty
  PointTask task = PointTask::closest;
  double time_limit = 5;  // seconds a point
};

// The answers of one algorithm, one for each point.
struct PointAnswers {
  const PointQueryEntry* entry;
  std::vector<PointAnswer> of;
};

std::vector<Vec3d> read_points(const std::string& file) {
  std::vector<Vec3d> points;
  const files::CsvReader reader(file, {"x", "y", "z"});
  reader.read([&](const files::CsvReader::Row& row) {
    Vec3d& point = points.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = row.number(k);
      if (!std::isfinite(value)) {
        row.fail(fmt::format("column {}: found {}; expected a finite number", row.name(k),
                             base::shortened(row.text(k))));
      }
      point[static_cast<Eigen::Index>(k)] = value;
    }
  });
  return points;
}

// Asks about all points, in a child process. Prints the failures.
PointAnswers ask_about(const PointQueryEntry& entry, const TriangleMesh& mesh,
                       const std::vector<Vec3d>& points, const PointsOptions& options) {
  PointAnswers answers = {&entry, std::vector<PointAnswer>(points.size())};
  auto solved = process::isolated_answers<PointAnswer>(
      points.size(), {.item_seconds = options.time_limit}, [&] {
        std::shared_ptr<PointQuery> query = entry.make();
        query->bind(mesh);
        return [&points, &options, query](std::size_t item) {
          PointAnswer answer;
          query->query(options.task, {&points[item], 1}, {&answer, 1});
          return answer;
        };
      });
  answers.of = std::move(solved.answers);
  print_failures(entry.info.name, solved.failures,
                 [](std::size_t item) { return fmt::format("point {}", item); });
  return answers;
}

void write_point_row(files::CsvWriter& csv, std::size_t point, const PointAnswers& answers,
                     PointTask task) {
  const PointAnswer& answer = answers.of[point];
  csv.field(point).field(answers.entry->info.name).field(to_string(task));
  csv.field(task == PointTask::side ? to_string(answer.side) : "").field(answer.distance);
  if (answer.triangle == PointAnswer::no_triangle) {
    csv.field("");
  } else {
    csv.field(static_cast<std::int64_t>(answer.triangle));
  }
  for (const double x : answer.closest) csv.field(x);
  csv.field(to_string(answer.status));
  csv.end_row();
}

void print_points_summary(const std::vector<PointAnswers>& all) {
  fmt::print("{:<24} {:>9}  {}\n", "algorithm", "points", "status");
  for (const PointAnswers& answers : all) {
    std::map<Status, std::size_t> statuses;
    for (const PointAnswer& answer : answers.of) ++statuses[answer.status];
    fmt::print("{:<24} {:>9}  {}\n", answers.entry->info.name, answers.of.size(),
               status_counts(statuses));
  }
}

// An open surface has no sides.
void check_closed(const std::string& file, const TriangleMesh& mesh) {
  const auto edge = geometry::open_edge(mesh.vertices, mesh.triangles);
  if (!edge) return;
  const auto& [from, to] = *edge;
  throw base::InputError(
      fmt::format("{}: the surface is open at the edge from [{}, {}, {}] to [{}, {}, {}]; --task "
                  "side expects each edge as often in one direction as in the other",
                  file, from[0], from[1], from[2], to[0], to[1], to[2]));
}

// Proves the exact answer for each point.
void save_point_proofs(const TriangleMesh& mesh, const std::vector<Vec3d>& points,
                       const PointsOptions& options) {
  SavedCertificates saved(options.saved);
  saved.head(files::mesh_line(mesh));
  const auto setup = [&] {
    return [&, prover = std::make_shared<oracle::MeshProver>(mesh)](
               std::size_t i) -> std::optional<std::string> {
      const auto certificate = options.task == PointTask::side ? prover->prove_side(points[i])
                                                               : prover->prove_nearest(points[i]);
      if (!certificate) return {};
      return files::to_json(files::StoredPointCertificate{i, *certificate});
    };
  };
  saved.add_each(points.size(), options.time_limit, setup,
                 [](std::size_t i) { return fmt::format("point {}", i); });
  saved.close();
}

int verify_point_proofs(const PointsOptions& options) {
  const std::vector<Vec3d> points =
      options.points.empty() ? std::vector<Vec3d>{} : read_points(options.points);
  Verdicts verdicts(options.certificates);
  QuestionNumbers numbers;
  std::optional<oracle::CheckedMesh> mesh;
  const auto take_mesh = [&](const TriangleMesh& read) {
    numbers.begin();
    mesh.emplace(read);
  };
  const auto take = [&](const files::StoredPointCertificate& stored, std::int64_t line) {
    std::string why = numbers.fault(stored.point);
    if (why.empty() && !options.points.empty() &&
        (stored.point >= points.size() || stored.certificate.point != points[stored.point])) {
      why = "--points has another point of that number, or none";
    }
    if (why.empty()) why = mesh->fault(stored.certificate);
    verdicts.add(line, fmt::format("point {}", stored.point), why);
  };
  return verdicts.of(
      [&] { files::read_point_certificates(options.certificates, take_mesh, take); });
}

void ask_points(const PointsOptions& options) {
  expect_without_certificates(options.mesh, "MESH");
  expect_without_certificates(options.points, "--points");
  expect_without_certificates(options.out, "--out");
  const auto entries = kinds::select(registry::entries<PointQueryEntry>(),
                                     kinds::split_names(options.query), "point query");
  geometry::Mesh read = geometry::read_surface(options.mesh);
  tell_extent(options.mesh, read.vertices);
  const TriangleMesh mesh{std::move(read.vertices), std::move(read.triangles)};
  if (options.task == PointTask::side) check_closed(options.mesh, mesh);
  const std::vector<Vec3d> points = read_points(options.points);
  files::check_outputs({{"MESH", options.mesh}, {"--points", options.points}},
                       {{"--out", options.out}, {"--save-certificates", options.saved}});
  std::vector<PointAnswers> all;
  all.reserve(entries.size());
  for (const PointQueryEntry* entry : entries)
    all.push_back(ask_about(*entry, mesh, points, options));
  files::CsvWriter csv(options.out, {"point", "algorithm", "task", "side", "distance", "triangle",
                                     "x", "y", "z", "status"});
  for (std::size_t point = 0; point < points.size(); ++point) {
    for (const PointAnswers& answers : all) write_point_row(csv, point, answers, options.task);
  }
  csv.close();
  print_points_summary(all);
  if (!options.saved.empty()) save_point_proofs(mesh, points, options);
}

}  // namespace

void add_points(Arguments command) {
  static const Arguments::Choices<PointTask> tasks = {{"closest", PointTask::closest},
                                                      {"side", PointTask::side}};
  const auto options = std::make_shared<PointsOptions>();
  command.text("MESH", options->mesh, "The mesh: OBJ, OFF, STL or PLY (required)");
  command.text("--points", options->points, "Points: CSV with x, y and z (required)");
  command.text("--query", options->query, "Point queries: names joined by commas, or all")
      .show_default();
  command
      .one_of("--task", options->task, tasks,
              "The closest point, or the side of the surface, which has to be closed")
      .show_default("closest");
  add_time_limit(command, options->time_limit, "Seconds that a point may take, and its proof")
      .show_default();
  command.text("--out", options->out, "The CSV file to write (required)");
  command.text("--save-certificates", options->saved,
               "Also prove the exact answer for each point, and write the proofs to this file");
  command.text(
      "--certificates", options->certificates,
      "Only verify the proofs in this file, and with --points that each is of the point of "
      "its number");
  command.exclude_others("--certificates", {"--points"});
  command.job([options]() -> int {
    if (!options->certificates.empty()) return verify_point_proofs(*options);
    ask_points(*options);
    return exit_done;
  });
}

}  // namespace touchstone::commands

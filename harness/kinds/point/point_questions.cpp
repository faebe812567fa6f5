// What is asked of points at a mesh: the closest point, or the side of the surface.
#include "harness/kinds/point/point_kind.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/oracle/certificates/parts/mesh_certificate_check.h"
#include "algorithms/oracle/rays/exact_mesh_proofs.h"
#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/files/csv.h"
#include "harness/files/ray_certificates.h"
#include "harness/geometry/concave_bodies.h"
#include "harness/kinds/proofs.h"
#include "harness/kinds/questions.h"

namespace touchstone::kinds {
namespace {

std::vector<Vec3d> read_points(const std::string& file) {
  std::vector<Vec3d> points;
  const files::CsvReader reader(file, {"x", "y", "z"});
  reader.read([&](const files::CsvReader::Row& row) {
    points.emplace_back(finite_number(row, 0), finite_number(row, 1), finite_number(row, 2));
  });
  return points;
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

std::string label_of_point(std::size_t point) { return fmt::format("point {}", point); }

class PointQuestions final : public AnswersOf<PointQueryEntry, PointAnswer> {
 public:
  explicit PointQuestions(const QuestionInput& input)
      : input_(input),
        task_(static_cast<PointTask>(
            asked_task(input, std::array<std::string_view, 2>{to_string(PointTask::closest),
                                                              to_string(PointTask::side)}))) {
    select(input.names, "point query", Precision::float64);
    mesh_ = read_target_mesh(input);
    if (task_ == PointTask::side) check_closed(input.text("--in"), mesh_);
    points_ = read_points(input.file.string());
  }

  std::size_t size() const override { return points_.size(); }
  std::string label(std::size_t point) const override { return label_of_point(point); }
  std::vector<files::NamedFile> inputs() const override {
    return {{"FILE", input_.file}, {"--in", input_.text("--in")}};
  }
  std::string_view unit() const override { return "m"; }

  std::vector<AskFailure> ask(std::size_t contestant) override {
    const PointQueryEntry& entry = *asked_[contestant].entry;
    return ask_each(
        contestant, input_.seconds(), [](std::size_t) { return true; },
        [&] {
          std::shared_ptr<PointQuery> query = entry.make();
          query->bind(mesh_);
          return [this, query](std::size_t i) {
            PointAnswer answer;
            query->query(task_, {&points_[i], 1}, {&answer, 1});
            return answer;
          };
        });
  }

  std::vector<std::string> columns() const override {
    return {"point", "algorithm", "task", "side", "distance", "triangle", "x", "y", "z", "status"};
  }
  void write(files::CsvWriter& csv, std::size_t point, std::size_t contestant) const override {
    const PointAnswer& given = answer(point, contestant);
    csv.field(point).field(info(contestant).name).field(to_string(task_));
    csv.field(task_ == PointTask::side ? to_string(given.side) : "").field(given.distance);
    write_if(csv, given.triangle != PointAnswer::no_triangle, given.triangle);
    for (const double x : given.closest) csv.field(x);
    csv.field(to_string(given.status));
    csv.end_row();
  }

  ShownAnswer shown(std::size_t point, std::size_t contestant) const override {
    const PointAnswer& given = answer(point, contestant);
    ShownAnswer shown = {.verdict = {}, .status = given.status, .number = given.distance};
    if (task_ == PointTask::side) {
      shown.verdict = to_string(given.side);
    } else {
      const bool is_found = !std::isnan(given.distance);
      shown.verdict = is_found ? "found" : "none";
      if (is_found) {
        shown.more =
            fmt::format("at ({}, {}, {})", given.closest.x(), given.closest.y(), given.closest.z());
      }
    }
    return shown;
  }
  std::vector<std::string_view> verdicts() const override {
    if (task_ == PointTask::side) return {"outside", "surface", "inside", "unknown"};
    return {"found", "none"};
  }

  Proving proving() const override {
    const auto setup = [this] {
      return [this, prover = std::make_shared<oracle::MeshProver>(mesh_)](
                 std::size_t i) -> std::optional<std::string> {
        const auto certificate = task_ == PointTask::side ? prover->prove_side(points_[i])
                                                          : prover->prove_nearest(points_[i]);
        if (!certificate) return {};
        return files::to_json(files::StoredPointCertificate{i, *certificate});
      };
    };
    return {{files::mesh_line(mesh_)}, points_.size(), setup, label_of_point};
  }

 private:
  QuestionInput input_;
  PointTask task_;
  TriangleMesh mesh_;
  std::vector<Vec3d> points_;
};

}  // namespace

std::vector<QueryOption> point_options() { return {option::target, option::saved}; }

std::unique_ptr<Questions> read_point_questions(const QuestionInput& input) {
  return std::make_unique<PointQuestions>(input);
}

bool verify_point_proofs(const std::string& proofs, const std::filesystem::path& file) {
  const std::vector<Vec3d> points =
      file.empty() ? std::vector<Vec3d>{} : read_points(file.string());
  Verdicts verdicts(proofs);
  QuestionNumbers numbers;
  std::optional<oracle::CheckedMesh> mesh;
  const auto take_mesh = [&](const TriangleMesh& read) {
    numbers.begin();
    mesh.emplace(read);
  };
  const auto take = [&](const files::StoredPointCertificate& stored, std::int64_t line) {
    std::string why = numbers.fault(stored.point);
    if (why.empty() && !file.empty() &&
        (stored.point >= points.size() || stored.certificate.point != points[stored.point])) {
      why = "FILE has another point of that number, or none";
    }
    if (why.empty()) why = mesh->fault(stored.certificate);
    verdicts.add(line, fmt::format("point {}", stored.point), why);
  };
  return verdicts.of([&] { files::read_point_certificates(proofs, take_mesh, take); });
}

}  // namespace touchstone::kinds

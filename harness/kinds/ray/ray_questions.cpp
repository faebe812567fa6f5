// What is asked of rays at a mesh, and files of them.
#include "harness/kinds/ray/ray_kind.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
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
#include "harness/base/input_file.h"
#include "harness/files/csv.h"
#include "harness/files/ray_certificates.h"
#include "harness/files/text_file.h"
#include "harness/kinds/proofs.h"
#include "harness/kinds/questions.h"

namespace touchstone::kinds {
namespace {

class RayQuestions final : public AnswersOf<RayCastEntry, RayHit> {
 public:
  explicit RayQuestions(const QuestionInput& input)
      : input_(input), task_(asked_ray_task(input)), scalar_(input.scalar()) {
    select(input.names, "ray cast", scalar_);
    mesh_ = read_target_mesh(input);
    rays_ = read_rays(input.file);
  }

  std::size_t size() const override { return rays_.size(); }
  std::string label(std::size_t ray) const override { return label_of_ray(ray); }
  std::vector<files::NamedFile> inputs() const override {
    return {{"FILE", input_.file}, {"--in", input_.text("--in")}};
  }
  std::string_view unit() const override { return "lengths of the direction"; }
  std::vector<std::string> of_other_scalar() const override {
    return names_where([&](const RayCastEntry& entry) { return !offers(entry, scalar_); });
  }

  std::vector<AskFailure> ask(std::size_t contestant) override {
    const RayCastEntry& entry = *asked_[contestant].entry;
    const bool takes = offers(entry, task_) && offers(entry, scalar_);
    return ask_each(
        contestant, input_.seconds(), [&](std::size_t) { return takes; },
        [&] {
          std::shared_ptr<RayCast> caster = entry.make({scalar_});
          caster->bind(mesh_);
          return [this, caster](std::size_t i) {
            RayHit hit;
            caster->cast(task_, {&rays_[i], 1}, {&hit, 1});
            return hit;
          };
        });
  }

  std::vector<std::string> columns() const override {
    return {"ray", "algorithm", "scalar", "hit", "t", "triangle", "u", "v", "status"};
  }
  void write(files::CsvWriter& csv, std::size_t ray, std::size_t contestant) const override {
    const RayHit& hit = answer(ray, contestant);
    csv.field(ray).field(info(contestant).name).field(to_string(scalar_));
    csv.field(hit.hit ? 1 : 0).field(hit.t);
    write_if(csv, hit.triangle != RayHit::no_triangle, hit.triangle);
    csv.field(hit.u).field(hit.v).field(to_string(hit.status));
    csv.end_row();
  }

  ShownAnswer shown(std::size_t ray, std::size_t contestant) const override {
    const RayHit& hit = answer(ray, contestant);
    ShownAnswer shown = {
        .verdict = hit.hit ? "hit" : "miss", .status = hit.status, .number = hit.t};
    if (hit.triangle != RayHit::no_triangle) shown.more = fmt::format("triangle {}", hit.triangle);
    return shown;
  }
  std::vector<std::string_view> verdicts() const override { return {"hit", "miss"}; }

  Proving proving() const override {
    auto mesh = std::make_shared<TriangleMesh>(mesh_);
    for (Vec3d& vertex : mesh->vertices) vertex = rounded(vertex);
    const auto setup = [this, mesh] {
      return [this, mesh, prover = std::make_shared<oracle::MeshProver>(*mesh)](
                 std::size_t i) -> std::optional<std::string> {
        Ray ray = {rounded(rays_[i].origin), rounded(rays_[i].direction), rays_[i].t_max};
        if (scalar_ == Precision::float32) ray.t_max = nearest_float(ray.t_max);
        const auto certificate =
            prover->prove_ray(ray.origin, ray.direction, ray.t_max, task_ == RayTask::closest);
        if (!certificate) return {};
        return files::to_json(files::StoredRayCertificate{i, *certificate});
      };
    };
    return {{files::mesh_line(*mesh)}, rays_.size(), setup, label_of_ray};
  }

 private:
  Vec3d rounded(const Vec3d& v) const {
    return scalar_ == Precision::float64 ? v : nearest_float(v);
  }

  QuestionInput input_;
  RayTask task_;
  Precision scalar_;
  TriangleMesh mesh_;
  std::vector<Ray> rays_;
};

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

}  // namespace

std::vector<QueryOption> ray_options() { return {option::target, option::scalar, option::saved}; }

std::unique_ptr<Questions> read_ray_questions(const QuestionInput& input) {
  return std::make_unique<RayQuestions>(input);
}

bool verify_ray_proofs(const std::string& proofs, const std::filesystem::path& file) {
  const std::vector<Ray> rays = file.empty() ? std::vector<Ray>{} : read_rays(file);
  Verdicts verdicts(proofs);
  QuestionNumbers numbers;
  const auto add = [&](const auto& stored, std::int64_t line, auto& target) {
    std::string why = numbers.fault(stored.ray);
    if (why.empty() && !file.empty() &&
        (stored.ray >= rays.size() || !is_of(stored.certificate, rays[stored.ray]))) {
      why = "FILE has another ray of that number, or none";
    }
    if (why.empty()) why = target->fault(stored.certificate);
    verdicts.add(line, label_of_ray(stored.ray), why);
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
  return verdicts.of([&] { files::read_ray_certificates(proofs, targets); });
}

void write_ray(const std::filesystem::path& file, const Ray& ray) {
  const Vec3d &o = ray.origin, &d = ray.direction;
  files::write_text(file,
                    fmt::format("origin_x,origin_y,origin_z,direction_x,direction_y,direction_z,"
                                "t_max\n{},{},{},{},{},{},{}\n",
                                o.x(), o.y(), o.z(), d.x(), d.y(), d.z(), ray.t_max));
}

std::vector<Ray> read_rays(const std::filesystem::path& file) {
  std::vector<Ray> rays;
  const files::CsvReader reader(file, {"origin_x", "origin_y", "origin_z", "direction_x",
                                       "direction_y", "direction_z", "t_max"});
  reader.read([&](const files::CsvReader::Row& row) {
    const auto finite = [&](std::size_t column) { return finite_number(row, column); };
    Ray ray{{finite(0), finite(1), finite(2)}, {finite(3), finite(4), finite(5)}, row.number(6)};
    if (ray.direction.isZero(0)) row.fail("the direction is zero; expected one that is not");
    if (!(ray.t_max >= 0)) {
      row.fail(fmt::format("column t_max: found {}; expected 0 or more, or inf",
                           base::shortened(row.text(6))));
    }
    rays.push_back(std::move(ray));
  });
  return rays;
}

std::string label_of_ray(std::size_t ray) { return fmt::format("ray {}", ray); }

RayTask asked_ray_task(const QuestionInput& input) {
  const std::array names = {to_string(RayTask::closest), to_string(RayTask::any)};
  return static_cast<RayTask>(asked_task(input, names));
}

}  // namespace touchstone::kinds

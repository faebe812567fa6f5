// What is asked of rays at the bodies of a scene.
#include "harness/kinds/scene_ray/scene_ray_questions.h"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/oracle/rays/exact_scene_ray_proofs.h"
#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/files/csv.h"
#include "harness/files/ray_certificates.h"
#include "harness/kinds/questions.h"
#include "harness/kinds/ray/ray_kind.h"
#include "harness/scene/player.h"

namespace touchstone::kinds {
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

class SceneRayQuestions final : public AnswersOf<SceneRayCastEntry, SceneRayHit> {
 public:
  explicit SceneRayQuestions(const QuestionInput& input)
      : input_(input), task_(asked_ray_task(input)) {
    if (input.scalar() != Precision::float64) {
      throw base::InputError("--scalar float: rays at scenes are cast in double alone");
    }
    select(input.names, "ray cast of scenes", Precision::float64);
    const std::string file = needed_target(input);
    const scene::Scene scene = scene::load_scene(file);
    bodies_ = bodies_at(scene, input.count("--frame").value_or(0), file);
    rays_ = read_rays(input.file);
    inputs_ = scene.inputs();
    inputs_.push_back({"FILE", input.file});
  }

  std::size_t size() const override { return rays_.size(); }
  std::string label(std::size_t ray) const override { return label_of_ray(ray); }
  std::vector<files::NamedFile> inputs() const override { return inputs_; }
  std::string_view unit() const override { return "lengths of the direction"; }

  std::vector<AskFailure> ask(std::size_t contestant) override {
    const SceneRayCastEntry& entry = *asked_[contestant].entry;
    return ask_each(
        contestant, input_.seconds(), [](std::size_t) { return true; },
        [&] {
          std::shared_ptr<SceneRayCast> caster = entry.make();
          caster->bind(bodies_);
          return [this, caster](std::size_t i) {
            SceneRayHit hit;
            caster->cast(task_, {&rays_[i], 1}, {&hit, 1});
            return hit;
          };
        });
  }

  std::vector<std::string> columns() const override {
    return {"ray", "algorithm", "scalar", "hit",  "t",        "triangle", "u",
            "v",   "status",    "body",   "part", "normal_x", "normal_y", "normal_z"};
  }
  void write(files::CsvWriter& csv, std::size_t ray, std::size_t contestant) const override {
    const SceneRayHit& hit = answer(ray, contestant);
    csv.field(ray).field(info(contestant).name).field(to_string(Precision::float64));
    csv.field(hit.hit ? 1 : 0).field(hit.t);
    // A mesh's part is its triangle; where in it the hit lies is not told.
    write_if(csv, hit.body != SceneRayHit::none && bodies_[hit.body].body.mesh, hit.part);
    csv.field("").field("").field(to_string(hit.status));
    for (const std::uint32_t number : {hit.body, hit.part}) {
      write_if(csv, number != SceneRayHit::none, number);
    }
    for (const double x : hit.normal) csv.field(x);
    csv.end_row();
  }

  ShownAnswer shown(std::size_t ray, std::size_t contestant) const override {
    const SceneRayHit& hit = answer(ray, contestant);
    ShownAnswer shown = {
        .verdict = hit.hit ? "hit" : "miss", .status = hit.status, .number = hit.t};
    if (hit.body != SceneRayHit::none) {
      shown.more = fmt::format("body {}, part {}", hit.body, hit.part);
    }
    return shown;
  }
  std::vector<std::string_view> verdicts() const override { return {"hit", "miss"}; }

  Proving proving() const override {
    std::vector<files::PlacedConcave> named;
    std::vector<oracle::PlacedBody> placed;
    for (const auto& [body, pose] : bodies_) {
      named.push_back({body, pose});
      placed.push_back({body, pose});
    }
    const auto setup = [this, placed] {
      return [this, prover = std::make_shared<oracle::SceneRayProver>(placed)](
                 std::size_t i) -> std::optional<std::string> {
        const auto certificate = prover->prove(rays_[i].origin, rays_[i].direction, rays_[i].t_max,
                                               task_ == RayTask::closest);
        if (!certificate) return {};
        return files::to_json(files::StoredSceneRayCertificate{i, *certificate});
      };
    };
    return {{files::scene_line(named)}, rays_.size(), setup, label_of_ray};
  }

 private:
  QuestionInput input_;
  RayTask task_;
  std::vector<SceneBody> bodies_;
  std::vector<Ray> rays_;
  std::vector<files::NamedFile> inputs_;
};

}  // namespace

std::vector<QueryOption> scene_ray_options() {
  return {option::target,
          option::scalar,
          {"--frame", QueryOption::Value::natural, "Which frame of a scene (default: 0)"},
          option::saved};
}

std::unique_ptr<Questions> read_scene_ray_questions(const QuestionInput& input) {
  return std::make_unique<SceneRayQuestions>(input);
}

}  // namespace touchstone::kinds

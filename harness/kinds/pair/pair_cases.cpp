// Reads cases of pairs, tells who is asked, and writes the rows of answers.
#include "harness/kinds/pair/pair_cases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <utility>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/geometry/concave_bodies.h"
#include "harness/kinds/selection.h"
#include "harness/scene/kinematics.h"

namespace touchstone::kinds {
namespace {

std::optional<std::size_t> natural(const std::string& word) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

// Two bodies of a scene, in one of its frames.
files::ConcaveCase case_of_scene(const QuestionInput& input) {
  const std::string file = input.file.string();
  const scene::Scene scene = scene::load_scene(input.file);
  if (!scene.recording.empty()) {
    throw base::InputError(file, 0,
                           "is a recording of boxes; expected a scene of bodies for --bodies");
  }
  const std::vector<std::string> words = split_names(input.text("--bodies"));
  std::vector<std::size_t> places;
  for (const std::string& word : words) {
    const std::optional<std::size_t> place = natural(word);
    if (place && *place < scene.bodies.size()) places.push_back(*place);
  }
  if (words.size() != 2 || places.size() != 2 || places[0] == places[1]) {
    throw base::InputError(fmt::format(
        "--bodies: found '{}'; expected two bodies of {}, by their numbers from 0 to {}",
        fmt::join(words, " "), file, scene.bodies.size() - 1));
  }
  const int frame = input.count("--frame").value_or(0);
  if (frame >= scene.frames) {
    throw base::InputError(fmt::format("--frame: found {}; expected at most {}, the last of {}",
                                       frame, scene.frames - 1, file));
  }
  scene::Kinematics kinematics(scene);
  while (kinematics.frame() < frame) kinematics.next();
  files::ConcaveCase c;
  c.id = fmt::format("{}-{}", places[0], places[1]);
  const auto place = [&](std::size_t number, ConcaveBody& body, Pose& pose) {
    if (!kinematics.is_present(number)) {
      throw base::InputError(fmt::format("{}: body {} is not there in frame {}; expected another",
                                         file, number, frame));
    }
    const std::uint32_t shape = scene.bodies[number].shape;
    const ConcaveBody* const concave = scene.concave_of(shape);
    if (concave != nullptr) {
      body = *concave;
      c.is_convex = false;
    } else {
      body.parts.push_back({.shape = scene.shapes[shape], .pose = {}});
    }
    pose = kinematics.poses()[number];
  };
  place(places[0], c.a, c.pose_a);
  place(places[1], c.b, c.pose_b);
  return c;
}

std::vector<files::ConcaveCase> chosen_cases(const QuestionInput& input, files::MeshFiles& meshes) {
  if (input.has("--bodies")) return {case_of_scene(input)};
  if (input.has("--frame")) {
    throw base::InputError("--frame was given; expected it with --bodies alone");
  }
  std::vector<files::ConcaveCase> cases = files::read_concave_cases(input.file, &meshes);
  if (!input.has("--id")) return cases;
  const std::string id = input.text("--id");
  std::erase_if(cases, [&](const files::ConcaveCase& c) { return c.id != id; });
  if (cases.empty()) {
    throw base::InputError(fmt::format("{}: has no case '{}'; expected the id of one for --id",
                                       input.file.string(), id));
  }
  return cases;
}

}  // namespace

std::vector<files::ConcaveCase> asked_pair_cases(const QuestionInput& input) {
  files::MeshFiles meshes;
  std::vector<files::ConcaveCase> cases = chosen_cases(input, meshes);
  for (const auto& [file, body] : meshes.all()) {
    tell_extent(file, body->mesh ? body->mesh->vertices : geometry::surface_of(*body).vertices);
  }
  return cases;
}

bool asks_concave_phases(const QuestionInput& input) {
  const bool is_theirs = std::ranges::any_of(input.names, [](const std::string& name) {
    return registry::find<ConcaveEntry>(name) != nullptr &&
           registry::find<NarrowPhaseEntry>(name) == nullptr;
  });
  if (is_theirs || input.task == "contacts") return true;
  files::MeshFiles meshes;
  return !std::ranges::all_of(chosen_cases(input, meshes), &files::ConcaveCase::is_convex);
}

std::vector<QueryOption> pair_case_options(const std::vector<QueryOption>& further) {
  using Value = QueryOption::Value;
  std::vector<QueryOption> options = {
      {"--bodies", Value::list, "FILE is a scene: asks about these two of its bodies, such as 3 7"},
      {"--frame", Value::natural, "Which frame of a scene (default: 0)"},
      {.name = "--id",
       .value = Value::text,
       .help = "Asks the cases with this id alone",
       .excludes = "--bodies"},
      {"--page", Value::text, "A page of the pairs that opens in a browser, .html"},
      {"--built-page", Value::text, "Another built page than the launcher's"}};
  options.insert(options.end(), further.begin(), further.end());
  return options;
}

std::vector<std::string> query_columns() {
  return {"id",    "algorithm", "scalar",   "task",     "answer",     "status",       "distance",
          "lower", "upper",     "normal_x", "normal_y", "normal_z",   "a_x",          "a_y",
          "a_z",   "b_x",       "b_y",      "b_z",      "iterations", "support_calls"};
}

void write_query_fields(files::CsvWriter& csv, const QueryRowHead& head, const Outcome& outcome) {
  csv.field(head.id).field(head.algorithm).field(head.scalar).field(head.task);
  csv.field(to_string(outcome.answer)).field(to_string(outcome.status));
  csv.field(outcome.distance).field(outcome.lower).field(outcome.upper);
  for (const Vec3d& v : {outcome.normal, outcome.witness_a, outcome.witness_b}) {
    for (const double x : v) csv.field(x);
  }
  for (const std::int32_t count : {outcome.iterations, outcome.support_calls}) {
    write_if(csv, count >= 0, count);
  }
}

ShownAnswer shown_outcome(const Outcome& outcome) {
  return {.verdict = to_string(outcome.answer),
          .status = outcome.status,
          .number = outcome.distance,
          .lower = outcome.lower,
          .upper = outcome.upper};
}

}  // namespace touchstone::kinds

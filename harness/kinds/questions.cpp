// What the questions of all kinds do alike.
#include "harness/kinds/questions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/geometry/mesh.h"

namespace touchstone::kinds {

std::string QuestionInput::text(std::string_view option, std::string without) const {
  const auto at = options.find(option);
  return at == options.end() ? std::move(without) : at->second;
}

std::optional<double> QuestionInput::number(std::string_view option) const {
  const auto at = options.find(option);
  if (at == options.end()) return std::nullopt;
  const std::string& word = at->second;
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    throw base::InputError(fmt::format("{}: found '{}'; expected a number", option, word));
  }
  return value;
}

std::optional<int> QuestionInput::count(std::string_view option) const {
  const auto at = options.find(option);
  if (at == options.end()) return std::nullopt;
  const std::string& word = at->second;
  int value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) {
    throw base::InputError(fmt::format("{}: found '{}'; expected an integer", option, word));
  }
  return value;
}

Precision QuestionInput::scalar() const {
  return text("--scalar") == "float" ? Precision::float32 : Precision::float64;
}

std::size_t asked_task(const QuestionInput& input, std::span<const std::string_view> tasks,
                       std::size_t fullest) {
  if (input.task.empty()) return fullest;
  const auto at = std::ranges::find(tasks, input.task);
  if (at == tasks.end()) {
    throw base::InputError(
        fmt::format("--task: found '{}'; expected one of {}", input.task, fmt::join(tasks, ", ")));
  }
  return static_cast<std::size_t>(at - tasks.begin());
}

std::string needed_target(const QuestionInput& input) {
  if (!input.has("--in")) {
    throw base::InputError(
        "--in is missing; expected the mesh, or for rays the mesh or the scene, that is asked");
  }
  return input.text("--in");
}

TriangleMesh read_target_mesh(const QuestionInput& input) {
  const std::string file = needed_target(input);
  geometry::Mesh read = geometry::read_surface(file);
  tell_extent(file, read.vertices);
  return {std::move(read.vertices), std::move(read.triangles)};
}

double finite_number(const files::CsvReader::Row& row, std::size_t column) {
  const double value = row.number(column);
  if (std::isfinite(value)) return value;
  row.fail(fmt::format("column {}: found {}; expected a finite number", row.name(column),
                       base::shortened(row.text(column))));
}

Proving Questions::proving() const {
  throw base::InputError("--save-certificates: there are no proofs of what is asked");
}

void tell_extent(const std::string& file, std::span<const Vec3d> vertices) {
  if (vertices.empty()) return;
  Vec3d low = vertices[0], high = low;
  for (const Vec3d& v : vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  const Vec3d size = high - low;
  fmt::print(stderr, "{}: {} vertices in a box of {:.4g} x {:.4g} x {:.4g}, taken as metres\n",
             file, vertices.size(), size.x(), size.y(), size.z());
}

namespace option {

using Value = QueryOption::Value;
const QueryOption scalar = {"--scalar",
                            Value::choice,
                            "What is calculated in (default: double; of manifolds, each that an "
                            "algorithm has)",
                            {"float", "double"}};
const QueryOption tolerance = {"--tolerance", Value::positive,
                               "Where an algorithm stops. Of distances, as a part of the pair's "
                               "size; of casts and features, the distance in "
                               "metres at which they are in contact"};
const QueryOption max_iterations = {"--max-iterations", Value::count,
                                    "Greatest number of iterations of each loop of a query"};
const QueryOption target = {
    "--in", Value::file,
    "The mesh (OBJ, OFF, STL or PLY; a face of more corners becomes a fan of triangles around its "
    "first, which is "
    "right for convex faces), or for rays also the scene (TOML, or rigid-ipc's JSON)"};
const QueryOption saved = {
    "--save-certificates", Value::text,
    "Also prove the exact answer to each question, and write the proofs to this file"};

}  // namespace option

}  // namespace touchstone::kinds

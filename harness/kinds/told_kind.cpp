// Looks at the first lines of a file, and for pairs at all.
#include "harness/kinds/questions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/files/json_line.h"
#include "harness/files/packed_files.h"
#include "harness/kinds/pair/pair_cases.h"
#include "harness/kinds/selection.h"
#include "harness/scene/mesh_frames.h"

namespace touchstone::kinds {
namespace {

std::string kind_names() {
  std::vector<std::string_view> names;
  for (const Kind* kind : asked_kinds()) names.push_back(kind->name());
  return fmt::format("{}", fmt::join(names, ", "));
}

const Kind* named_kind(const std::string& word) {
  if (word.empty()) return nullptr;
  const Kind* const kind = find_asked_kind(word);
  if (kind != nullptr) return kind;
  throw base::InputError(fmt::format("--kind: found '{}'; expected one of {}", word, kind_names()));
}

bool is_scene(const std::string& file) {
  return file.ends_with(".toml") || file.ends_with(".json") || file.ends_with(".aabbs");
}

const Kind& ray_kind_at(const QuestionInput& input) {
  return is_scene(input.text("--in")) ? scene_ray_kind() : ray_kind();
}

// The first line that is not blank, without white space around it; empty if there is none.
std::string first_line(const std::filesystem::path& file) {
  constexpr std::string_view blank = " \t\r\n";
  files::LineReader lines(file);
  while (const auto line = lines.next()) {
    std::string_view text = *line;
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    const auto begin = text.find_first_not_of(blank);
    if (begin == std::string_view::npos) continue;
    return std::string(text.substr(begin, text.find_last_not_of(blank) + 1 - begin));
  }
  return "";
}

bool moves(const std::filesystem::path& file) {
  files::LineReader lines(file);
  while (const auto line = lines.next()) {
    // Most lines need not be parsed.
    if (line->find("\"displacement\"") == std::string_view::npos &&
        line->find("\"rotation_vector\"") == std::string_view::npos) {
      continue;
    }
    const files::Json value = files::Json::parse(*line, nullptr, false);
    for (const char* body : {"a", "b"}) {
      if (!value.is_object() || !value.contains(body)) continue;
      if (value[body].contains("displacement") || value[body].contains("rotation_vector")) {
        return true;
      }
    }
  }
  return false;
}

// The kind of a file of comma-separated values, by its header, or by its first row if it has none.
const Kind& kind_of_columns(const QuestionInput& input, const std::string& header) {
  const std::vector<std::string> columns = split_names(header);
  const auto has = [&](std::string_view name) {
    return std::ranges::find(columns, name) != columns.end();
  };
  if (has("origin_x") || has("direction_x")) return ray_kind_at(input);
  if (has("min_x") || has("max_x")) return box_kind();
  const std::string target = input.text("--in");
  if (target.ends_with(".urdf")) return configuration_kind();  // joints may be called x, y and z
  if (has("x") && has("y") && has("z")) return point_kind();
  if (is_scene(target)) return configuration_kind();
  const bool is_numbers = header.find_first_not_of("0123456789.,+-eE ") == std::string::npos;
  if (is_numbers && !header.empty() && columns.size() >= 3 && columns.size() <= 7) {
    return feature_kind();
  }
  throw base::InputError(
      input.file, 1,
      fmt::format("found '{}'; expected cases in JSON, or a header of boxes (frame,id,min_x,...), "
                  "rays (origin_x,...) "
                  "or points (x,y,z), four vertices a query, or joint values with --in ROBOT.urdf; "
                  "or --kind with one of {}",
                  base::shortened(header), kind_names()));
}

}  // namespace

const Kind& told_kind(const QuestionInput& input, const std::string& word) {
  if (const Kind* const kind = named_kind(word)) {
    return kind == &ray_kind() ? ray_kind_at(input) : *kind;
  }
  if (input.has("--settled")) return manifold_kind();
  if (input.has("--bodies")) return asks_concave_phases(input) ? mesh_kind() : pair_kind();
  const std::string file = input.file.string();
  if (file.ends_with(".urdf")) return configuration_kind();
  if (file.ends_with(".toml")) {
    throw base::InputError(
        file, 0,
        "is a scene; expected --bodies with two of its bodies, --kind configuration if it has a "
        "robot, or a file of questions");
  }
  if (file.ends_with(".aabbs") || scene::are_mesh_frames(input.file)) return box_kind();
  if (std::filesystem::is_directory(input.file)) return feature_kind();
  const std::string first = first_line(input.file);
  const bool is_json =
      first.starts_with('{') || file.ends_with(".jsonl") || file.ends_with(".jsonl.zst");
  if (!is_json) return kind_of_columns(input, first);
  if (moves(input.file)) return cast_kind();
  return asks_concave_phases(input) ? mesh_kind() : pair_kind();
}

const Kind& told_kind_of_proofs(const std::filesystem::path& proofs, const std::string& word) {
  if (const Kind* const kind = named_kind(word)) return *kind;
  const Kind* found = nullptr;
  files::LineReader lines(proofs);
  while (found == nullptr) {
    const auto line = lines.next();
    if (!line) break;
    const files::Json value = files::Json::parse(*line, nullptr, false);
    if (!value.is_object()) continue;
    if (value.contains("ray") || value.contains("bodies")) found = &ray_kind();
    if (value.contains("point")) found = &point_kind();
    if (!value.contains("a")) continue;
    const auto answer = value.find("answer");
    const bool is_cast = answer != value.end() && (*answer == "hit" || *answer == "miss");
    found = is_cast ? &cast_kind() : &mesh_kind();
  }
  return found == nullptr ? mesh_kind() : *found;
}

}  // namespace touchstone::kinds

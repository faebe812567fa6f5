// Selects the mesh reader and reads tokens and numbers for all of them.
#include "harness/geometry/mesh.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "harness/base/input_file.h"
#include "harness/geometry/mesh_format.h"
#include "harness/models/model.h"

namespace touchstone::geometry {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

// A token as a message quotes it.
std::string shown(std::string_view token) {
  return token.empty() ? "nothing" : "'" + base::shortened(token) + "'";
}

std::string_view without_plus(std::string_view token) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
  return token;
}

}  // namespace

bool TextCursor::next_line() {
  if (rest_.empty()) {
    line_ = {};
    return false;
  }
  const auto end =
      std::find_if(rest_.begin(), rest_.end(), [](char c) { return c == '\n' || c == '\r'; });
  line_ = std::string_view(rest_.begin(), end);
  rest_ = std::string_view(end, rest_.end());
  rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, rest_.size()));
  ++line_number_;
  return true;
}

bool TextCursor::next_filled_line() {
  while (next_line()) {
    line_ = line_.substr(0, line_.find('#'));
    if (!std::all_of(line_.begin(), line_.end(), is_blank)) return true;
  }
  return false;
}

std::string_view TextCursor::token() {
  const auto begin = std::find_if_not(line_.begin(), line_.end(), is_blank);
  const auto end = std::find_if(begin, line_.end(), is_blank);
  const std::string_view found(begin, end);
  line_ = std::string_view(end, line_.end());
  return found;
}

std::string_view TextCursor::token_across_lines(std::string_view expected) {
  while (true) {
    if (const std::string_view found = token(); !found.empty()) return found;
    if (!next_line()) fail("the file ends early; expected " + std::string(expected));
  }
}

Vec3d TextCursor::point() {
  const double x = number();
  const double y = number();
  const double z = number();
  return {x, y, z};
}

double TextCursor::to_number(std::string_view token) const {
  const std::string_view text = without_plus(token);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end == text.data() + text.size()) {
    if (error == std::errc() && std::isfinite(value)) return value;
    if (error == std::errc::result_out_of_range && text.find("e-") != std::string_view::npos) {
      return 0;
    }
    if (error == std::errc::result_out_of_range && text.find("E-") != std::string_view::npos) {
      return 0;
    }
  }
  fail("expected a finite number, found " + shown(token));
}

std::int64_t TextCursor::to_integer(std::string_view token) const {
  const std::string_view text = without_plus(token);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    fail("expected an integer, found " + shown(token));
  }
  return value;
}

void add_fan(Mesh& mesh, std::span<const std::uint32_t> polygon) {
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    mesh.triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
  }
}

namespace {

using Reader = Mesh (*)(const std::string& file, std::string_view text);

// Null for an unknown extension.
Reader reader_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".obj"   ? read_obj
         : ending == ".off" ? read_off
         : ending == ".stl" ? read_stl
         : ending == ".ply" ? read_ply
                            : nullptr;
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& file) {
  return reader_of(file) != nullptr || models::is_model_file(file);
}

Mesh read_mesh(const std::filesystem::path& file) {
  if (models::is_model_file(file)) {
    models::ModelMesh whole = models::whole_mesh(file.string(), models::read_model(file));
    return {std::move(whole.vertices), std::move(whole.triangles)};
  }
  const Reader reader = reader_of(file);
  if (reader == nullptr) {
    throw base::InputError(file.string(), 0,
                           "unknown mesh format; expected .obj, .off, .stl or .ply, or a model "
                           "(.glb, .gltf, .dae, .fbx, .3ds)");
  }
  const std::string text = base::read_whole(file, base::largest_file, "a mesh file");
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    throw base::InputError(file.string(), 1, "text in UTF-16; expected ASCII or UTF-8");
  }
  Mesh mesh = reader(file.string(), text);
  if (mesh.vertices.empty()) {
    throw base::InputError(file.string(), 0, "the mesh has no vertices; expected at least one");
  }
  return mesh;
}

Mesh read_surface(const std::filesystem::path& file) {
  Mesh mesh = read_mesh(file);
  if (mesh.triangles.empty()) {
    throw base::InputError(file.string(), 0, "the mesh has no faces; expected at least one");
  }
  return mesh;
}

}  // namespace touchstone::geometry

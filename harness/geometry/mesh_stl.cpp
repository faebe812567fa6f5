// Reads STL as text or binary. Corners with equal coordinates become one vertex.
#include <bit>
#include <cctype>
#include <cmath>
#include <map>

#include "harness/geometry/mesh_format.h"

namespace touchstone::geometry {
namespace {

class Welder {
 public:
  std::uint32_t operator()(const Vec3d& p) {
    const auto [at, is_new] =
        index_.insert({{p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(mesh.vertices.size())});
    if (is_new) mesh.vertices.push_back(p);
    return at->second;
  }
  Mesh mesh;

 private:
  std::map<std::array<double, 3>, std::uint32_t> index_;
};

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) {
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  }
  return value;
}

constexpr std::size_t header_size = 84, triangle_size = 50;

std::size_t size_in_header(std::string_view bytes) {
  return header_size + triangle_size * std::size_t{little_endian(bytes, 80)};
}

Mesh read_binary(const std::string& file, std::string_view bytes) {
  if (bytes.size() < header_size || bytes.size() < size_in_header(bytes)) {
    throw base::InputError(
        file, 0,
        "the file ends early at byte " + std::to_string(bytes.size()) +
            "; expected a text STL ('solid ...') or a binary one of " +
            std::to_string(bytes.size() < header_size ? header_size : size_in_header(bytes)) +
            " bytes");
  }
  Welder weld;
  const std::size_t count = little_endian(bytes, 80);
  for (std::size_t t = 0; t < count; ++t) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t at = header_size + t * triangle_size + 12 * (corner + 1);
      Vec3d p;
      for (int k = 0; k < 3; ++k) {
        p[k] = std::bit_cast<float>(little_endian(bytes, at + 4 * static_cast<std::size_t>(k)));
        if (!std::isfinite(p[k])) {
          throw base::InputError(
              file, 0, "expected finite coordinates in the vertex at byte " + std::to_string(at));
        }
      }
      triangle[corner] = weld(p);
    }
    weld.mesh.triangles.push_back(triangle);
  }
  return std::move(weld.mesh);
}

std::string lower(std::string_view token) {
  std::string result(token);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

Mesh read_text(const std::string& file, std::string_view text) {
  Welder weld;
  TextCursor cursor(file, text);
  std::vector<std::uint32_t> loop;
  bool open = false;      // between solid and endsolid
  bool in_loop = false;   // between outer and endloop
  bool has_loop = false;  // of the facet
  while (cursor.next_line()) {
    const std::string keyword = lower(cursor.token());
    if (keyword.empty()) continue;
    if (in_loop && keyword != "vertex" && keyword != "endloop") {
      cursor.fail("expected vertex or endloop");
    }
    if (keyword == "solid") {
      open = true;
    } else if (keyword == "endsolid") {
      open = false;
    } else if (!open) {
      cursor.fail("expected 'solid'");
    } else if (keyword == "facet") {
      has_loop = false;
    } else if (keyword == "outer") {
      in_loop = has_loop = true;
      loop.clear();
    } else if (keyword == "vertex") {
      if (!in_loop) cursor.fail("expected 'outer loop' before vertices");
      loop.push_back(weld(cursor.point()));
    } else if (keyword == "endloop") {
      if (loop.size() != 3) cursor.fail("expected a loop of three vertices");
      add_fan(weld.mesh, loop);
      in_loop = false;
      loop.clear();
    } else if (keyword != "endfacet") {
      cursor.fail("expected facet, outer loop, vertex, endloop, endfacet or endsolid");
    } else if (!has_loop) {
      cursor.fail("expected an outer loop in the facet");
    }
  }
  if (open) cursor.fail("the file ends early; expected 'endsolid'");
  return std::move(weld.mesh);
}

}  // namespace

Mesh read_stl(const std::string& file, std::string_view text) {
  // A binary file may start with "solid" too, but its size agrees with its count.
  const bool fits = text.size() >= header_size && text.size() == size_in_header(text);
  const bool is_text =
      !fits && lower(TextCursor(file, text).token_across_lines("solid")) == "solid";
  return is_text ? read_text(file, text) : read_binary(file, text);
}

}  // namespace touchstone::geometry

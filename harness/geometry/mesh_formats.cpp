// Reads OBJ, OFF and STL.
#include <bit>
#include <cctype>
#include <cmath>
#include <map>

#include "harness/geometry/mesh_format.h"

namespace touchstone::geometry {

// Reads Wavefront OBJ: the v and f lines; other lines are ignored.

Mesh read_obj(const std::string& file, std::string_view text) {
  Mesh mesh;
  TextCursor cursor(file, text);
  std::vector<std::uint32_t> polygon;
  std::int64_t highest = 0, highest_line = 0;  // faces may come before their vertices
  while (cursor.next_filled_line()) {
    const std::string_view keyword = cursor.token();
    if (keyword == "v") {
      mesh.vertices.push_back(cursor.point());
    } else if (keyword == "f") {
      polygon.clear();
      bool goes_on = false;  // on the next line, behind a backslash
      for (std::string_view token = cursor.token(); !token.empty() || goes_on;
           token = cursor.token()) {
        if (goes_on) {
          if (!token.empty()) cursor.fail("expected the line's end behind the backslash");
          if (!cursor.next_filled_line()) cursor.fail("the file ends early; expected a face");
          goes_on = false;
          continue;
        }
        goes_on = token.ends_with('\\');
        if (goes_on) token.remove_suffix(1);
        if (token.empty()) continue;
        const std::int64_t count = static_cast<std::int64_t>(mesh.vertices.size());
        std::int64_t index = cursor.to_integer(token.substr(0, token.find('/')));
        if (index < 0) index += count + 1;  // -1 is the last vertex so far
        if (index < 1 || index > INT64_C(0xffffffff)) {
          cursor.fail("vertex index '" + base::shortened(token) + "' out of range; there are " +
                      std::to_string(count) + " vertices so far");
        }
        if (index > highest) {
          highest = index;
          highest_line = cursor.line();
        }
        polygon.push_back(static_cast<std::uint32_t>(index - 1));
      }
      if (polygon.size() < 3) cursor.fail("expected a face of three corners or more");
      add_fan(mesh, polygon);
    }
  }
  if (highest > static_cast<std::int64_t>(mesh.vertices.size())) {
    throw base::InputError(file, highest_line,
                           "vertex index " + std::to_string(highest) + " out of range; there are " +
                               std::to_string(mesh.vertices.size()) + " vertices");
  }
  return mesh;
}

// Reads Geomview's OFF as text, one line per vertex and face. The prefixes that add normals,
// colours or texture coordinates are accepted, and their data ignored.

namespace {

bool is_header(std::string_view token) {
  if (!token.ends_with("OFF")) return false;
  token.remove_suffix(3);
  for (std::string_view prefix : {"ST", "C", "N"}) {
    if (token.starts_with(prefix)) token.remove_prefix(prefix.size());
  }
  return token.empty();
}

}  // namespace

Mesh read_off(const std::string& file, std::string_view text) {
  TextCursor cursor(file, text);
  const auto next_line = [&](const char* expected) {
    if (!cursor.next_filled_line()) {
      cursor.fail(std::string("the file ends early; expected ") + expected);
    }
  };
  next_line("OFF");
  if (!is_header(cursor.token())) {
    cursor.fail("expected OFF, COFF, NOFF, CNOFF or STOFF (three-dimensional, text)");
  }
  std::string_view token = cursor.token();
  if (token.empty()) {
    next_line("the counts of vertices, faces and edges");
    token = cursor.token();
  }
  const std::int64_t vertices = cursor.to_integer(token);
  const std::int64_t faces = cursor.integer();
  if (vertices < 0 || faces < 0 || vertices > INT64_C(0xffffffff)) {
    cursor.fail("expected counts of vertices and faces of zero or more");
  }

  Mesh mesh;
  for (std::int64_t i = 0; i < vertices; ++i) {
    next_line("a vertex");
    mesh.vertices.push_back(cursor.point());
  }
  std::vector<std::uint32_t> polygon;
  for (std::int64_t i = 0; i < faces; ++i) {
    next_line("a face");
    const std::int64_t corners = cursor.integer();
    if (corners < 1) cursor.fail("expected a face of one corner or more");
    polygon.clear();
    for (std::int64_t k = 0; k < corners; ++k) {
      const std::int64_t index = cursor.integer();
      if (index < 0 || index >= vertices) {
        cursor.fail("vertex index " + std::to_string(index) + " out of range; there are " +
                    std::to_string(vertices) + " vertices, from 0");
      }
      polygon.push_back(static_cast<std::uint32_t>(index));
    }
    add_fan(mesh, polygon);
  }
  if (cursor.next_filled_line()) {
    cursor.fail("more lines than the counts say; expected the file to end after " +
                std::to_string(faces) + " faces");
  }
  return mesh;
}

// Reads STL as text or binary. Corners with equal coordinates become one vertex.

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

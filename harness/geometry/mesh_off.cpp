// Reads Geomview's OFF as text, one line per vertex and face. The prefixes that add normals,
// colours or texture coordinates are accepted, and their data ignored.
#include "harness/geometry/mesh_format.h"

namespace touchstone::geometry {
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

}  // namespace touchstone::geometry

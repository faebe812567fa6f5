// Reads Wavefront OBJ: the v and f lines; other lines are ignored.
#include "harness/geometry/mesh_format.h"

namespace touchstone::geometry {

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

}  // namespace touchstone::geometry

// Functions shared by the mesh readers: tokens, numbers and places of errors. Used by mesh_*.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/geometry/mesh.h"

namespace touchstone::geometry {

// The readers, one per format. `text` is the whole file, `file` its name for errors. The result has
// finite vertices and indices in range; read_mesh rejects it if it has no vertex.
Mesh read_obj(const std::string& file, std::string_view text);
Mesh read_off(const std::string& file, std::string_view text);
Mesh read_stl(const std::string& file, std::string_view text);
Mesh read_ply(const std::string& file, std::string_view text);

// Reads a text line by line (LF, CRLF or CR), and a line token by token. A byte-order mark in front is left
// out.
class TextCursor {
 public:
  TextCursor(const std::string& file, std::string_view text)
      : file_(file), rest_(base::without_byte_order_mark(text)) {}

  // Advances to the next line; false after the last one.
  bool next_line();
  // Advances to the next line that has a token before a '#'.
  bool next_filled_line();
  // The next token of this line without its blanks; empty at the line's end.
  std::string_view token();
  // The next token, on this line or a later one. Fails at the end of the file.
  std::string_view token_across_lines(std::string_view expected);
  std::string_view rest_of_line() const { return line_; }
  std::string_view rest_of_file() const { return rest_; }

  // The next token of this line as a finite number. A number too small for a double is 0.
  double number() { return to_number(token()); }
  Vec3d point();
  std::int64_t integer() { return to_integer(token()); }
  double to_number(std::string_view token) const;
  std::int64_t to_integer(std::string_view token) const;

  std::int64_t line() const { return line_number_; }
  [[noreturn]] void fail(const std::string& message) const {
    throw base::InputError(file_, line_number_, message);
  }

 private:
  std::string file_;
  std::string_view rest_, line_;
  std::int64_t line_number_ = 0;
};

// Splits a polygon into triangles around its first corner. They cover it if it is convex.
void add_fan(Mesh& mesh, std::span<const std::uint32_t> polygon);

}  // namespace touchstone::geometry

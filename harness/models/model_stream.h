// What touchstone_read_model writes for the program that started it. Both are of one build, on one machine.
//
// Numbers have the machine's byte order. A count is an uint64, a real number a double, an index an uint32:
//   stream_begin
//   real: metres a unit of length; 9 reals, row by row: the turn from the file's axes to z up
//   count of meshes; of each: count of vertices, count of triangles, 3 reals a vertex, 3 indices a triangle
//   counts as LeftOut (model.h) has them, then that of skinned meshes
//   count of warnings; of each: count of bytes, the text
//   count of nodes, parents first; of each: its parent's number plus 1, or 0; count of bytes of its name, the
//     name; 12 reals: the rows of a 3 x 4 matrix to the parent's frame; count of its meshes, their indices
//   stream_end
#pragma once

#include <string_view>

namespace touchstone::models {

inline constexpr std::string_view stream_begin = "touchstone model 1\n", stream_end = "end\n";

// Exit statuses of the program. With `cannot_read` its standard error says why.
inline constexpr int exit_read = 0, exit_cannot_read = 1, exit_no_memory = 3;

}  // namespace touchstone::models

// A tetrahedron as a file of each format, for tests.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "algorithms/core/vec.h"

namespace touchstone::mesh_texts {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

inline const std::vector<Vec3d> tetrahedron = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline const Triangles sides = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

template <class T>
std::string bytes(T value, bool big = false) {
  std::string s(sizeof value, '\0');
  std::memcpy(s.data(), &value, sizeof value);
  if (big != (std::endian::native == std::endian::big)) std::reverse(s.begin(), s.end());
  return s;
}

inline std::string binary_stl(const std::string& title) {
  std::string s = title + std::string(80 - title.size(), ' ') + bytes<std::uint32_t>(4);
  for (const auto& side : sides) {
    for (int k = 0; k < 3; ++k) s += bytes<float>(0);
    for (std::uint32_t v : side) {
      for (double c : tetrahedron[v]) s += bytes(static_cast<float>(c));
    }
    s += bytes<std::uint16_t>(0);
  }
  return s;
}

inline std::string binary_ply(bool big) {
  std::string s =
      std::string("ply\nformat binary_") + (big ? "big" : "little") +
      "_endian 1.0\ncomment made up\nelement camera 2\nproperty list uchar short numbers\n"
      "property double angle\nelement vertex 4\nproperty uchar red\nproperty double z\n"
      "property float x\nproperty short y\nproperty list uint float weights\n"
      "element face 4\nproperty list uchar int vertex_indices\nproperty ushort flags\n"
      "end_header\n";
  for (int i = 0; i < 2; ++i) {
    s += bytes<std::uint8_t>(2) + bytes<std::int16_t>(-1, big) + bytes<std::int16_t>(7, big);
    s += bytes<double>(0.5, big);
  }
  for (const Vec3d& v : tetrahedron) {
    s += bytes<std::uint8_t>(255) + bytes<double>(v.z(), big) +
         bytes(static_cast<float>(v.x()), big);
    s += bytes(static_cast<std::int16_t>(v.y()), big) + bytes<std::uint32_t>(1, big) +
         bytes<float>(0.25f, big);
  }
  for (const auto& side : sides) {
    s += bytes<std::uint8_t>(3);
    for (std::uint32_t v : side) s += bytes(static_cast<std::int32_t>(v), big);
    s += bytes<std::uint16_t>(9, big);
  }
  return s;
}

inline const char* const obj = R"(# a tetrahedron
mtllib none.mtl
o body
v 0 0 0
v 1.0 0 0 1
v 0 1e0 0 0.5 0.5 0.5
v +0 -0.0 1 # last
vt 0 0
vn 0 0 1
usemtl none
s off
f 1 3 2
f 1/1 2/1 4/1
f 2//1 3//1 4//1
f -2/1/1 -4/1/1 -1/1/1
)";

inline const char* const off = R"(OFF
# a tetrahedron
4 4 6

0 0 0
1 0 0  # second
0 1 0
0 0 1
3 0 2 1
3 0 1 3  255 0 0
3 1 2 3 0.5 0.5 0.5
3 2 0 3
)";

inline const char* const stl = R"(solid a b c
 facet normal 0 0 -1
  outer loop
   vertex 0 0 0
   vertex 0 1 0
   vertex 1 0 0
  endloop
 endfacet
 FACET NORMAL 0 -1 0
  OUTER LOOP
   VERTEX 0 0 0
   VERTEX 1 0 0
   VERTEX 0 0 1e0
  ENDLOOP
 ENDFACET
endsolid a b c
)";

inline const char* const ply = R"(ply
format ascii 1.0
comment a tetrahedron
obj_info none
element vertex 4
property float nx
property float y
property float x
property float32 z
element face 4
property uchar red
property list uchar uint vertex_index
end_header
0 0 0 0
0 0 1 0
0 1 0 0
0 0 0 1
1 3 0 2 1
1 3 0 1 3
1 3 1 2 3
1 3 2 0 3
)";

}  // namespace touchstone::mesh_texts

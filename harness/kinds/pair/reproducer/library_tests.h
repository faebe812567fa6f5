// What a test of a library begins with: its includes, functions that make its bodies, and `check`. Each text
// is C++ that stands by itself, and has the same functions:
//   sphere(r) capsule(r, h) box(x, y, z) cylinder(r, h) cone(r, h) ellipsoid(x, y, z)
//   hull({{x, y, z}, ...}, {corners of a face, its vertices, ...})
//   Pose{{nine numbers by rows}, {x, y, z}}
//   check(id, a, pose_a, b, pose_b, {side, number, tolerance, has_distance, has_depth})
// with half lengths and half extents, and the fields of ExpectedAnswer (reproducer.cpp).
#pragma once

#include <span>
#include <string_view>

namespace touchstone::kinds {

struct LibraryTest {
  std::string_view algorithm;  // its name in the registry
  std::string_view compile;    // flags behind g++ -std=c++17 FILE
  std::string_view preamble;   // `SOLVER` in it stands for `solver`
  std::string_view solver;
  bool in_float;       // the library's numbers are floats
  bool is_googletest;  // each case is a TEST, and there is no main
};

std::span<const LibraryTest> library_tests();

}  // namespace touchstone::kinds

// What a test of a library in Python or JavaScript is made of. The library is one that an adapter asks, such as
// mujoco@3.10.0. A test has three parts: `head`, which defines signed_distance(a, b) of two bodies as the protocol of
// peers has them; the list `cases`; and the check of all, which is the same for a language.
#pragma once

#include <span>
#include <string_view>

namespace touchstone::kinds {

struct ScriptTest {
  std::string_view library;     // the name of the adapter
  std::string_view extension;   // of the file: ".py" or ".mjs"
  std::string_view function;    // of the library that is asked
  std::string_view package;     // what is installed
  std::string_view head;        // `PACKAGE` in it stands for `package`
  std::string_view shapes;      // that it takes, each between blanks
  bool in_float;                // the library's numbers are floats
  std::string_view lacks = {};  // a version of the adapter that the package does not have

  bool is_python() const { return extension == ".py"; }
};

std::span<const ScriptTest> script_tests();
// What stands behind the cases.
std::string_view script_end(const ScriptTest& test);

}  // namespace touchstone::kinds

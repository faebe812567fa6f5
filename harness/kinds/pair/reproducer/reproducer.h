// Pairs and their exact answers as a test of a library, in its own language, that can be sent to its authors: it
// needs the library and a compiler, and none of this program.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "algorithms/narrow_phase.h"
#include "harness/files/cases.h"

namespace touchstone::kinds {

inline constexpr double script_error = 1e-4;  // part of the pair's size

// The algorithms of libraries that have such a form, joined by commas. Those of an adapter have it in each version, such
// as mujoco@3.10.0.
std::string names_with_reproducers();
// The usual file of the test, such as "fcl-indep_test.cpp"; empty if the algorithm has no such form.
std::string reproducer_file(std::string_view algorithm);

// The text of the test, which fails if the library is on the wrong side of contact, or a number that the task
// asks for is off by more than usual_depth_error of the pair's size, as in the summary of a run. In Python and JavaScript
// the limit is script_error, which is also how near to contact a side does not count. `file` is its name, for
// the line that compiles it; its ending says which language, where there are two. The cases are rounded to the library's
// numbers first. Cases with shapes that the library does not take are left out, with a comment. Throws InputError for an
// algorithm that has no such form, or not in that language, and if no case is left.
std::string reproducer(std::string_view algorithm, std::span<const files::Case> cases, Task task,
                       const std::filesystem::path& file);

}  // namespace touchstone::kinds

// Compiles modules for tests.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/harness/run_shell.h"
#include "tests/project_folder.h"

namespace touchstone {

// Compiles a file of this folder with these options. Returns the shared object.
inline std::string compiled_module(const std::filesystem::path& folder, const std::string& source,
                                   const std::string& name, const std::string& options) {
  const std::string root = project_folder, file = (folder / (name + ".so")).string();
  const Ran ran =
      run_shell("c++ -std=c++20 -shared -fPIC " + options + " -I" + root +
                "/algorithms/module -o " + file + " " + root + "/tests/harness/modules/" + source);
  EXPECT_EQ(ran.status, 0) << ran.text;
  return file;
}

// faulty.cpp with this fault.
inline std::string built_module(const std::filesystem::path& folder, const std::string& fault) {
  const std::string more = fault == "no_symbol" ? " -DWITHOUT_SYMBOL" : "";
  return compiled_module(folder, "faulty.cpp", fault, "-DFAULT=" + fault + more);
}

}  // namespace touchstone

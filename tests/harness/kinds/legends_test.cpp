// The page of method says of each kind what the kind itself says is right.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "harness/kinds/kind.h"
#include "tests/project_folder.h"

namespace touchstone::kinds {
namespace {

TEST(Legends, StandInThePageOfMethod) {
  std::ifstream file(std::filesystem::path(project_folder) / "results/method.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  ASSERT_FALSE(kinds().empty());
  for (const Kind* kind : kinds()) {
    const std::string row = fmt::format("| `{}` | {} |", kind->name(), kind->legend());
    EXPECT_NE(page.find(row), std::string::npos) << "results/method.md has no row\n" << row;
  }
}

}  // namespace
}  // namespace touchstone::kinds

// results/columns.md against the declarations of the rows that it documents.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/project_folder.h"

namespace touchstone {

// Expects `docs` (from column_docs) between the marks of this file in results/columns.md:
// "<!-- begin raw.csv -->" and "<!-- end raw.csv -->". With TOUCHSTONE_WRITE_COLUMNS set in the
// environment the page is written anew instead.
inline void expect_documented(const std::string& file, const std::string& docs) {
  const std::filesystem::path path =
      std::filesystem::path(project_folder) / "results" / "columns.md";
  std::ifstream stream(path, std::ios::binary);
  std::string page{std::istreambuf_iterator<char>(stream), {}};
  const std::string begin = "<!-- begin " + file + " -->\n";
  const std::size_t from = page.find(begin);
  const std::size_t to = page.find("<!-- end " + file + " -->\n");
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos && from < to)
      << path << " has no marks of " << file;
  const std::size_t first = from + begin.size();
  if (std::getenv("TOUCHSTONE_WRITE_COLUMNS") != nullptr) {
    std::ofstream(path, std::ios::binary) << page.replace(first, to - first, docs);
    return;
  }
  EXPECT_EQ(page.substr(first, to - first), docs)
      << "The declared columns of " << file
      << " have changed: run this test with TOUCHSTONE_WRITE_COLUMNS=1 to write " << path;
}

}  // namespace touchstone

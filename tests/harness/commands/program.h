// Runs the program as a user runs it.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "harness/files/csv.h"
#include "tests/harness/run_shell.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {

// Runs the program with these arguments, as the shell splits them.
inline Ran run_program(const std::string& arguments) {
  return run_shell(TOUCHSTONE_PROGRAM " " + arguments);
}

// Runs it, and expects status 2, this text and no new file in the folder.
inline void expect_refusal(const std::string& arguments, const std::string& text,
                           const TemporaryFolder& folder) {
  const auto before = folder.names();
  const Ran ran = run_program(arguments);
  EXPECT_EQ(ran.status, 2) << arguments << "\n" << ran.text;
  EXPECT_THAT(ran.text, testing::HasSubstr(text)) << arguments;
  EXPECT_EQ(folder.names(), before) << arguments;
}

// Returns the rows of a CSV file with these columns.
inline std::vector<std::vector<std::string>> read_rows(const std::filesystem::path& file,
                                                       const std::vector<std::string>& columns) {
  std::vector<std::vector<std::string>> rows;
  files::CsvReader(file, columns).read([&](const files::CsvReader::Row& row) {
    std::vector<std::string>& texts = rows.emplace_back();
    for (std::size_t i = 0; i < columns.size(); ++i) texts.emplace_back(row.text(i));
  });
  return rows;
}

}  // namespace touchstone

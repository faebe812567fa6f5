// A finished run that is cut as if it had been killed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/harness/stopped_folder.h"

namespace touchstone {

inline std::string whole_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Returns the end of the first line, behind its line feed.
inline std::size_t end_of_first_line(const std::string& text) { return text.find('\n') + 1; }

// Cuts raw.csv after `bytes`; the last whole unit ends after `whole` bytes of it. departures.csv is
// that of a run without any until then.
inline void stop_run(const std::filesystem::path& folder, std::size_t whole, std::size_t bytes) {
  stop_folder(folder, 1,
              {{"raw.csv", whole},
               {"departures.csv", end_of_first_line(whole_file(folder / "departures.csv"))}});
  std::filesystem::resize_file(folder / "raw.csv", bytes);
}

// Stops it in the middle of a line, after about this part of raw.csv. The last whole unit is the
// last block's check, or the last round, that ends before it.
inline void stop_run(const std::filesystem::path& folder, double part) {
  const std::string raw = whole_file(folder / "raw.csv");
  const auto bytes = static_cast<std::size_t>(part * static_cast<double>(raw.size()));
  const auto fields = [&](std::size_t begin) {
    std::vector<std::string> found(1);
    for (std::size_t i = begin; raw[i] != '\n'; ++i) {
      if (raw[i] == ',') {
        found.emplace_back();
      } else {
        found.back() += raw[i];
      }
    }
    return found;
  };
  const std::vector<std::string> names = fields(0);
  const auto round_of = [&](std::size_t begin) {
    const std::vector<std::string> row = fields(begin);
    std::string round;
    for (std::size_t i = 0; i < names.size(); ++i) {
      for (const char* name : {"kind", "block", "task", "pair_kind", "square", "round"}) {
        // A check pass is one unit, even if its rows are about several algorithms.
        if (names[i] == name && (row[1] == "sample" || i <= 2)) round += row[i] + ",";
      }
    }
    return round;
  };
  std::size_t whole = end_of_first_line(raw);
  std::string before;
  for (std::size_t line = whole; line < bytes; line = raw.find('\n', line) + 1) {
    const std::string round = round_of(line);
    if (round != before) whole = line;
    before = round;
  }
  stop_run(folder, whole, bytes);
}

}  // namespace touchstone

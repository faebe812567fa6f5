// The words of summaries: numbers with units, and lists that are cut off.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/stats/statistics.h"

namespace touchstone::stats {

inline constexpr std::size_t most_named = 4;  // in a line

std::string ratio_text(double ratio);
std::string ratio_text(const MedianInterval& ratio);
// Returns the number with a comma for each thousand.
std::string count_text(std::int64_t count);
std::string metres_text(double metres);
std::string seconds_text(double seconds);
// Returns the label without its scalar if that is double, as most are.
std::string short_label(std::string label);
// Joins the first words, and counts the others.
std::string list_text(const std::vector<std::string>& words, std::size_t most = most_named);
// Does the same in lines of the page's width that are indented.
std::string lines_text(const std::vector<std::string>& words, std::size_t indent,
                       std::size_t most = most_named);
// Returns the two most frequent names.
std::string most_often(const std::vector<std::string>& names);

}  // namespace touchstone::stats

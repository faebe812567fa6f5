// Tables in Markdown.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace touchstone::stats {

// One row; what would end a cell is made harmless.
std::string markdown_row(const std::vector<std::string>& cells);

// The header and the rule below it; the first `words` columns are to the left, the others to the
// right.
std::string markdown_header(const std::vector<std::string>& names, std::size_t words = 1);

// A number to four digits, "-" for NaN.
std::string cell(double value);

// InputError where the file cannot be written whole.
void write_text(const std::filesystem::path& file, const std::string& content);

}  // namespace touchstone::stats

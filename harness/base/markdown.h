// Tables in Markdown, and text files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace touchstone::base {

// One row; characters that would end a cell are escaped.
std::string markdown_row(const std::vector<std::string>& cells);

// The header and the rule below it. The first `words` columns are aligned left, the others right.
std::string markdown_header(const std::vector<std::string>& names, std::size_t words = 1);

// A number with four digits, or "-" for NaN.
std::string cell(double value);

// Throws InputError if the file cannot be written whole.
void write_text(const std::filesystem::path& file, const std::string& content);

}  // namespace touchstone::base

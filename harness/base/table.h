// A table of texts, for a terminal or as Markdown.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace touchstone::base {

class Table {
 public:
  // In Markdown the first `words` columns are aligned left and the others right.
  explicit Table(std::vector<std::string> header, std::size_t words = 1)
      : rows_{std::move(header)}, words_(words) {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  bool is_empty() const { return rows_.size() == 1; }
  const std::vector<std::vector<std::string>>& rows() const { return rows_; }  // the header first

  // Control characters in cells are escaped (base::printable). Returns the table for a terminal: the first column is aligned left, the others right. A table
  // wider than the page is split into several, each with the first column again.
  std::string text(std::size_t page_width) const;
  // Returns the table as Markdown; characters that would end a cell are escaped.
  std::string markdown() const;

 private:
  std::vector<std::vector<std::string>> rows_;
  std::size_t words_;
};

// Returns a number with four digits, or "-" for NaN.
std::string cell(double value);

// Returns the terminal's width if standard output is a terminal, else 120 characters.
std::size_t page_width();

}  // namespace touchstone::base

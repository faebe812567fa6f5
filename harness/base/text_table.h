// Tables for a terminal.
#pragma once

#include <string>
#include <vector>

namespace touchstone {

// The first column is to the left, the others to the right. A table that is wider than the page is
// cut into several, each with the first column again.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) : rows_{std::move(header)} {}
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::string text(std::size_t page_width) const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

// The terminal's width where standard output is one, else 120.
std::size_t page_width();

}  // namespace touchstone

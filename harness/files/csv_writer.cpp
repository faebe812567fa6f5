// Writes CSV files that are whole or absent.
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "harness/files/csv.h"

namespace touchstone::files {

void append_csv_field(std::string& line, std::string_view text) {
  const bool plain = text.find_first_of(",\"\r\n") == std::string_view::npos &&
                     (text.empty() || (text.front() != ' ' && text.front() != '\t' &&
                                       text.back() != ' ' && text.back() != '\t'));
  if (plain) {
    line += text;
    return;
  }
  line += '"';
  for (const char c : text) {
    if (c == '"') line += '"';
    line += c;
  }
  line += '"';
}

CsvWriter::CsvWriter(std::filesystem::path file, const std::vector<std::string>& header, Keep keep)
    : file_(std::move(file), keep), columns_(header.size()) {
  if (file_.size() > 0) return;
  for (const std::string& name : header) field(name);
  if (!header.empty()) end_row();
}

CsvWriter& CsvWriter::field(std::string_view text) {
  if (fields_++ > 0) line_ += ',';
  append_csv_field(line_, text);
  return *this;
}

CsvWriter& CsvWriter::field(double value) {
  std::array<char, 32> text;
  if (std::isnan(value)) return field(std::string_view());
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return field(std::string_view(text.data(), end));
}

CsvWriter& CsvWriter::field(std::int64_t value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return field(std::string_view(text.data(), end));
}

void CsvWriter::end_row() {
  if (fields_ != columns_) {
    throw std::logic_error(fmt::format("a row of {} fields in {}, which has {} columns", fields_,
                                       file_.path().string(), columns_));
  }
  line_ += '\n';
  file_.write(line_);
  line_.clear();
  fields_ = 0;
}

}  // namespace touchstone::files

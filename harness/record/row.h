// A row of a CSV file, declared once, as one list of fields.
// Header, writing, reading and the documentation of its columns come from that list.
//
// Beside its struct each row type has a function (found by argument-dependent lookup)
//
//   template <row_of<Sample> Row, class Visit>
//   void columns(Row& row, Visit visit) {
//     visit("seconds", row.seconds, "Time of the whole window, seconds.");
//   }
//
// Rows that hold indices into lists take the lists as a further argument:
//
//   template <row_of<Answer> Row, class Visit>
//   void columns(Row& row, Visit visit, const Subjects& subjects) {
//     visit("algorithm", place_in(row.entry, subjects.size(), name_of), "The narrow phase.");
//   }
//
// A field is text, a whole number (a negative signed number and an empty optional are empty
// fields), a floating-point number (NaN is an empty field), a bool (0 or 1), an enumeration with a
// `to_string`, or a wrapper of fields.h. Arrays of counts are visited in a loop, a column each.
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <filesystem>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "harness/files/csv.h"
#include "harness/record/field_csv.h"
#include "harness/record/fields.h"

namespace touchstone::record {

// Holds for a row type and its const twin: one list of columns serves reading and writing.
template <class Row, class Type>
concept row_of = std::same_as<std::remove_const_t<Row>, Type>;

// Returns the names of the columns in their order.
template <class Row, class... Context>
std::vector<std::string> header_of(const Context&... context) {
  std::vector<std::string> names;
  const Row row{};
  columns(
      row, [&](std::string_view name, const auto&, std::string_view) { names.emplace_back(name); },
      context...);
  return names;
}

template <class Row, class... Context>
void write_row(files::CsvWriter& file, const Row& row, const Context&... context) {
  columns(
      row,
      [&](std::string_view, const auto& field, std::string_view) {
        row_detail::write(file, field);
      },
      context...);
  file.end_row();
}

// Writes a file of these rows.
template <class Row, class... Context>
void write_rows(std::filesystem::path path, const std::vector<Row>& rows,
                const Context&... context) {
  files::CsvWriter file(std::move(path), header_of<Row>(context...));
  for (const Row& row : rows) write_row(file, row, context...);
  file.close();
}

// Reads the row of a file that `reader_of` opens. Its InputError names file, line, column, the text
// found and the text expected.
template <class Row, class... Context>
Row read_row(const files::CsvReader::Row& fields, const Context&... context) {
  Row row{};
  std::size_t column = 0;
  columns(
      row,
      [&](std::string_view, auto&& field, std::string_view) {
        row_detail::read(row_detail::Cell{fields, column++}, field);
      },
      context...);
  return row;
}

template <class Row, class... Context>
files::CsvReader reader_of(std::filesystem::path file, const Context&... context) {
  std::vector<std::string> optional;
  const Row row{};
  columns(
      row,
      [&]<class Field>(std::string_view name, const Field&, std::string_view) {
        if (row_detail::is_newer<Field>) optional.emplace_back(name);
      },
      context...);
  return {std::move(file), header_of<Row>(context...), optional};
}

// Returns all rows of a file, which may have further columns, in any order.
template <class Row, class... Context>
std::vector<Row> read_rows(const std::filesystem::path& file, const Context&... context) {
  std::vector<Row> rows;
  reader_of<Row>(file, context...).read([&](const files::CsvReader::Row& fields) {
    rows.push_back(read_row<Row>(fields, context...));
  });
  return rows;
}

// Returns a table in Markdown: name, type and meaning of each column.
template <class Row, class... Context>
std::string column_docs(const Context&... context) {
  std::string text = "| column | type | meaning |\n|---|---|---|\n";
  const Row row{};
  columns(
      row,
      [&](std::string_view name, const auto& field, std::string_view meaning) {
        text += fmt::format("| `{}` | {} | {} |\n", name, row_detail::type_of(field), meaning);
      },
      context...);
  return text;
}

// Replaces line ends by blanks, because a row is a line.
std::string one_line(std::string text);

}  // namespace touchstone::record

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
#include <functional>
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

namespace row_detail {

// A field of any type. Lists of columns are compiled once for it, and not for each use of theirs.
class AnyField {
 public:
  template <bool reads, class Field>
  static AnyField of(Field& field) {
    return {&field, &acts_of<reads, std::remove_const_t<Field>>};
  }

  void write(files::CsvWriter& file) const { acts_->write(file, field_); }
  void read(const Cell& cell) const { acts_->read(cell, const_cast<void*>(field_)); }
  std::string type() const { return acts_->type(field_); }
  bool is_newer() const { return acts_->is_newer; }

 private:
  struct Acts {
    void (*write)(files::CsvWriter&, const void*);
    void (*read)(const Cell&, void*);  // none for a field of a constant row
    std::string (*type)(const void*);
    bool is_newer;
  };
  template <bool reads, class Field>
  static constexpr Acts acts_of = [] {
    Acts acts{[](files::CsvWriter& file, const void* field) {
                row_detail::write(file, *static_cast<const Field*>(field));
              },
              nullptr, [](const void* field) { return type_of(*static_cast<const Field*>(field)); },
              row_detail::is_newer<Field>};
    if constexpr (reads) {
      acts.read = [](const Cell& cell, void* field) {
        row_detail::read(cell, *static_cast<Field*>(field));
      };
    }
    return acts;
  }();
  AnyField(const void* field, const Acts* acts) : field_(field), acts_(acts) {}

  const void* field_;
  const Acts* acts_;
};

using Look = std::function<void(std::string_view name, AnyField field, std::string_view meaning)>;
template <bool reads>
struct Visit {
  const Look& look;
  template <class Field>
  void operator()(std::string_view name, Field&& field, std::string_view meaning) const {
    look(name, AnyField::of<reads>(field), meaning);
  }
};

template <class Row, class... Context>
void look_at(Row& row, const Look& look, const Context&... context) {
  columns(row, Visit<!std::is_const_v<Row>>{look}, context...);
}

}  // namespace row_detail

// Returns the names of the columns in their order.
template <class Row, class... Context>
std::vector<std::string> header_of(const Context&... context) {
  std::vector<std::string> names;
  const Row row{};
  row_detail::look_at(
      row, [&](std::string_view name, auto, auto) { names.emplace_back(name); }, context...);
  return names;
}

template <class Row, class... Context>
void write_row(files::CsvWriter& file, const Row& row, const Context&... context) {
  row_detail::look_at(
      row, [&](auto, row_detail::AnyField field, auto) { field.write(file); }, context...);
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
  row_detail::look_at(
      row,
      [&](auto, row_detail::AnyField field, auto) {
        field.read(row_detail::Cell{fields, column++});
      },
      context...);
  return row;
}

template <class Row, class... Context>
files::CsvReader reader_of(std::filesystem::path file, const Context&... context) {
  std::vector<std::string> optional;
  const Row row{};
  row_detail::look_at(
      row,
      [&](std::string_view name, row_detail::AnyField field, auto) {
        if (field.is_newer()) optional.emplace_back(name);
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
  row_detail::look_at(
      row,
      [&](std::string_view name, row_detail::AnyField field, std::string_view meaning) {
        text += fmt::format("| `{}` | {} | {} |\n", name, field.type(), meaning);
      },
      context...);
  return text;
}

// Replaces line ends by blanks, because a row is a line.
std::string one_line(std::string text);

}  // namespace touchstone::record

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
// `to_string`, or one of the wrappers below. Arrays of counts are visited in a loop, a column each.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "harness/base/enumerators.h"
#include "harness/files/csv.h"

namespace touchstone::record {

// Holds for a row type and its const twin: one list of columns serves reading and writing.
template <class Row, class Type>
concept row_of = std::same_as<std::remove_const_t<Row>, Type>;

// A field that names an element of a list: `name_of(i)` is the name of element i, for i below
// `count`.
template <class Index, class NameOf>
struct PlaceField {
  Index& index;
  std::size_t count;
  NameOf name_of;
};
template <class Index, class NameOf>
PlaceField<Index, NameOf> place_in(Index& index, std::size_t count, NameOf name_of) {
  return {index, count, std::move(name_of)};
}

// A field that follows from others: it is written, as `text()` returns it, and not read.
template <class Text>
struct DerivedField {
  Text text;
};
template <class Text>
DerivedField<Text> derived(Text text) {
  return {std::move(text)};
}

// A number written with `digits` significant digits, because it is an estimate.
template <class Number>
struct RoundedField {
  Number& value;
  int digits;
};
template <class Number>
RoundedField<Number> rounded(Number& value, int digits) {
  return {value, digits};
}

// A whole number that is written unchanged, negative ones too.
template <class Number>
struct SignedField {
  Number& value;
};
template <class Number>
SignedField<Number> with_sign(Number& value) {
  return {value};
}

// A column that older files lack: its field keeps its default there.
template <class Field>
struct NewerField {
  Field& field;
};
template <class Field>
NewerField<Field> newer(Field& field) {
  return {field};
}

namespace row_detail {

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;
template <class T>
inline constexpr bool is_newer = false;
template <class T>
inline constexpr bool is_newer<NewerField<T>> = true;
template <class T>
inline constexpr bool is_characters = false;
template <std::size_t size>
inline constexpr bool is_characters<std::array<char, size>> = true;

template <class T>
concept Whole = std::integral<T> && !std::same_as<T, bool>;
template <class T>
concept Enumeration = std::is_enum_v<T>;

// The place of a field that was read, for the message of an error.
struct Cell {
  const files::CsvReader::Row& row;
  std::size_t column;

  std::string_view text() const { return row.text(column); }
  [[noreturn]] void fail(std::string_view expected) const {
    row.fail(fmt::format("column {}: found '{}'; expected {}", row.name(column), text(), expected));
  }
};

template <Enumeration Enum>
std::string names_of() {
  std::vector<std::string_view> names;
  for (const Enum value : base::enumerators<Enum>) names.push_back(to_string(value));
  return fmt::format("{}", fmt::join(names, ", "));
}

// Plain fields follow.
template <class T>
std::string type_of(const T&) {
  if constexpr (is_optional<T>) {
    return type_of(typename T::value_type{}) + ", or empty";
  } else if constexpr (std::same_as<T, bool>) {
    return "0 or 1";
  } else if constexpr (std::is_enum_v<T>) {
    return names_of<T>();
  } else if constexpr (std::integral<T>) {
    return "whole number";
  } else if constexpr (std::floating_point<T>) {
    return "number";
  } else {
    return "text";
  }
}

template <class T>
void write(files::CsvWriter& file, const T& value) {
  if constexpr (is_optional<T>) {
    value ? write(file, *value) : void(file.field(std::string_view()));
  } else if constexpr (std::same_as<T, bool>) {
    file.field(value ? 1 : 0);
  } else if constexpr (std::is_enum_v<T>) {
    file.field(std::string_view(to_string(value)));
  } else if constexpr (std::signed_integral<T>) {
    value < 0 ? file.field(std::string_view()) : file.field(static_cast<std::int64_t>(value));
  } else if constexpr (std::integral<T>) {
    file.field(static_cast<std::int64_t>(value));
  } else if constexpr (std::floating_point<T>) {
    file.field(static_cast<double>(value));
  } else if constexpr (is_characters<T>) {
    file.field(std::string_view(value.data()));
  } else {
    file.field(std::string_view(value));
  }
}

template <Whole T>
void read_whole(const Cell& cell, T& value) {
  const std::int64_t number = cell.row.integer(cell.column);
  if (!std::in_range<T>(number)) {
    cell.fail(fmt::format("a whole number from {} to {}", std::numeric_limits<T>::min(),
                          std::numeric_limits<T>::max()));
  }
  value = static_cast<T>(number);
}

template <class T>
void read(const Cell& cell, T& value) {
  const std::string_view text = cell.text();
  if constexpr (is_optional<T>) {
    value.reset();
    if (!text.empty()) read(cell, value.emplace());
  } else if constexpr (std::same_as<T, bool>) {
    if (text != "0" && text != "1") cell.fail("0 or 1");
    value = text == "1";
  } else if constexpr (std::is_enum_v<T>) {
    for (const T choice : base::enumerators<T>) {
      if (to_string(choice) == text) {
        value = choice;
        return;
      }
    }
    cell.fail("one of " + names_of<T>());
  } else if constexpr (std::signed_integral<T>) {
    if (text.empty()) {
      value = -1;
    } else {
      read_whole(cell, value);
    }
  } else if constexpr (std::integral<T>) {
    read_whole(cell, value);
  } else if constexpr (std::floating_point<T>) {
    value = text.empty() ? std::numeric_limits<T>::quiet_NaN()
                         : static_cast<T>(cell.row.number(cell.column));
  } else if constexpr (is_characters<T>) {
    if (text.size() >= value.size())
      cell.fail(fmt::format("less than {} characters", value.size()));
    value.fill('\0');
    text.copy(value.data(), text.size());
  } else {
    value = std::string(text);
  }
}

// The wrappers follow.
template <class Index, class NameOf>
std::string type_of(const PlaceField<Index, NameOf>&) {
  return "name";
}
template <class Index, class NameOf>
void write(files::CsvWriter& file, const PlaceField<Index, NameOf>& field) {
  file.field(std::string_view(field.name_of(static_cast<std::size_t>(field.index))));
}
template <class Index, class NameOf>
void read(const Cell& cell, PlaceField<Index, NameOf>& field) {
  for (std::size_t i = 0; i < field.count; ++i) {
    if (field.name_of(i) == cell.text()) {
      field.index = static_cast<Index>(i);
      return;
    }
  }
  cell.fail("one of the names of this request");
}

template <class Text>
std::string type_of(const DerivedField<Text>&) {
  return "text";
}
template <class Text>
void write(files::CsvWriter& file, const DerivedField<Text>& field) {
  file.field(std::string_view(field.text()));
}
template <class Text>
void read(const Cell&, DerivedField<Text>&) {}

template <class Number>
std::string type_of(const RoundedField<Number>&) {
  return "number";
}
template <class Number>
void write(files::CsvWriter& file, const RoundedField<Number>& field) {
  const bool none = std::isnan(field.value);
  file.field(none ? std::string() : fmt::format("{:.{}e}", field.value, field.digits - 1));
}
template <class Number>
void read(const Cell& cell, RoundedField<Number>& field) {
  read(cell, field.value);
}

template <class Number>
std::string type_of(const SignedField<Number>&) {
  return "whole number";
}
template <class Number>
void write(files::CsvWriter& file, const SignedField<Number>& field) {
  file.field(static_cast<std::int64_t>(field.value));
}
template <class Number>
void read(const Cell& cell, SignedField<Number>& field) {
  read_whole(cell, field.value);
}

template <class Field>
std::string type_of(const NewerField<Field>& field) {
  return type_of(field.field);
}
template <class Field>
void write(files::CsvWriter& file, const NewerField<Field>& field) {
  write(file, field.field);
}
template <class Field>
void read(const Cell& cell, NewerField<Field>& field) {
  if (!cell.row.is_absent(cell.column)) read(cell, field.field);
}

}  // namespace row_detail

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

// Defines the type name, the text and the parsing of a row's field.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "harness/base/enumerators.h"
#include "harness/files/csv.h"
#include "harness/record/fields.h"

namespace touchstone::record {
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

template <class Value>
std::string type_of(const DerivedField<Value>&) {
  return type_of(std::remove_cvref_t<std::invoke_result_t<const Value&>>{});
}
template <class Value>
void write(files::CsvWriter& file, const DerivedField<Value>& field) {
  write(file, field.value());
}
template <class Value>
void read(const Cell&, DerivedField<Value>&) {}

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

template <class Number>
std::string type_of(const NonzeroField<Number>&) {
  return "whole number";
}
template <class Number>
void write(files::CsvWriter& file, const NonzeroField<Number>& field) {
  field.value == 0 ? void(file.field(std::string_view())) : write(file, field.value);
}
template <class Number>
void read(const Cell& cell, NonzeroField<Number>& field) {
  field.value = 0;
  if (!cell.text().empty()) read_whole(cell, field.value);
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

}  // namespace touchstone::record

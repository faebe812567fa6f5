// The wrappers of a row's fields, for fields that are not written as their plain value.
#pragma once

#include <cstddef>
#include <utility>

namespace touchstone::record {

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

// A field that follows from others: it is written, as `value()` returns it, and not read.
template <class Value>
struct DerivedField {
  Value value;
};
template <class Value>
DerivedField<Value> derived(Value value) {
  return {std::move(value)};
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

// A whole number whose 0 is an empty field.
template <class Number>
struct NonzeroField {
  Number& value;
};
template <class Number>
NonzeroField<Number> nonzero(Number& value) {
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

}  // namespace touchstone::record

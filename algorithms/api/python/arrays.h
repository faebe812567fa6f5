// NumPy's arrays as vectors, poses and numbers, with checks of their shapes and types. For this folder alone.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <touchstone/touchstone.hpp>

namespace py = pybind11;
namespace ts = touchstone;

namespace touchstone_python {

// Arrays of another layout, or at an odd address, are copied.
constexpr int plain =
    py::array::c_style | py::array::forcecast | py::detail::npy_api::NPY_ARRAY_ALIGNED_;
using Doubles = py::array_t<double, plain>;
using Places = py::array_t<std::uint32_t, plain>;
using Handles = py::array_t<std::uint64_t, plain>;

inline std::string shape_text(const py::array& array) {
  std::string text = "(";
  for (py::ssize_t k = 0; k < array.ndim(); ++k)
    text += (k == 0 ? "" : ", ") + std::to_string(array.shape(k));
  return text + ")";
}

// Throws unless the array has this shape; -1 stands for any length. An empty list is an array of no rows.
inline void check(const py::array& array, std::initializer_list<py::ssize_t> shape,
                  const char* what) {
  if (array.ndim() == 1 && array.shape(0) == 0 && *shape.begin() <= 0) return;
  bool fits = array.ndim() == static_cast<py::ssize_t>(shape.size());
  std::string expected;
  py::ssize_t k = 0;
  for (const py::ssize_t length : shape) {
    fits = fits && (length < 0 || array.shape(k) == length);
    expected += (k == 0 ? "" : ", ") + (length < 0 ? std::string("n") : std::to_string(length));
    ++k;
  }
  if (fits) return;
  throw ts::Error("found " + std::string(what) + " of the shape " + shape_text(array) +
                  "; expected (" + expected + ")");
}

// Numbers of any kind. Throws for what is no array of numbers.
inline Doubles doubles_of(const py::object& given, const char* what) {
  const Doubles array = Doubles::ensure(given);
  if (array) return array;
  PyErr_Clear();
  throw ts::Error("found no array of numbers as " + std::string(what) + "; expected one");
}

// Integers from 0 to the greatest of the type. Throws for others: none is rounded or cut.
template <class Array>
Array integers_of(const py::object& given, const char* what) {
  using Integer = typename Array::value_type;
  const py::array array = py::array::ensure(given);
  if (!array) {
    PyErr_Clear();
    throw ts::Error("found no array as " + std::string(what) + "; expected one of integers");
  }
  if (array.size() == 0) return Array(array);
  const char kind = array.dtype().kind();
  bool fits = kind == 'u' || kind == 'i';
  if (fits && kind == 'i') {
    const auto wide = py::array_t<std::int64_t, plain>(array);
    fits = std::all_of(wide.data(), wide.data() + wide.size(), [](std::int64_t number) {
      return number >= 0 &&
             static_cast<std::uint64_t>(number) <= std::numeric_limits<Integer>::max();
    });
  } else if (fits) {
    const auto wide = py::array_t<std::uint64_t, plain>(array);
    fits = std::all_of(wide.data(), wide.data() + wide.size(), [](std::uint64_t number) {
      return number <= std::numeric_limits<Integer>::max();
    });
  }
  if (fits) return Array(array);
  throw ts::Error("found " + std::string(what) +
                  " that are no integers of at least 0, or too great; expected such");
}

inline ts::Vec3 vec(const double* numbers) { return {numbers[0], numbers[1], numbers[2]}; }

inline ts::Vec3 vec_of(const Doubles& array, const char* what) {
  check(array, {3}, what);
  return vec(array.data());
}

inline py::array_t<double> array_of(const ts::Vec3& v) {
  py::array_t<double> array(3);
  double* const numbers = array.mutable_data();
  numbers[0] = v.x, numbers[1] = v.y, numbers[2] = v.z;
  return array;
}

// A matrix of 4 x 4 whose rows begin every four numbers, or of 3 x 3 with a translation.
inline ts::Pose pose_of(const double* rows, std::size_t width, const ts::Vec3& translation) {
  const double *x = rows, *y = rows + width, *z = rows + 2 * width;
  return {{x[0], y[0], z[0]}, {x[1], y[1], z[1]}, {x[2], y[2], z[2]}, translation};
}

inline ts::Pose pose_of_matrix(const double* rows) {
  return pose_of(rows, 4, {rows[3], rows[7], rows[11]});
}

inline ts::Pose pose_of(const py::object& given) {
  if (given.is_none()) return {};
  if (py::isinstance<py::tuple>(given) && py::len(given) == 2) {
    const auto both = given.cast<py::tuple>();
    const Doubles rotation = doubles_of(both[0], "a rotation");
    check(rotation, {3, 3}, "a rotation");
    return pose_of(rotation.data(), 3,
                   vec_of(doubles_of(both[1], "a translation"), "a translation"));
  }
  const Doubles matrix = doubles_of(given, "a pose");
  check(matrix, {4, 4}, "a pose");
  return pose_of_matrix(matrix.data());
}

}  // namespace touchstone_python

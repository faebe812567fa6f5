// Part of the oracle: the integers of the exact problem, and vectors of them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <concepts>
#include <cstdint>

// Boost 1.74 tests whether each type that meets a number is a container of bytes, and that test
// does not compile for Eigen's types.
template <class Type>
requires std::derived_from<Type, Eigen::EigenBase<Type>>
struct boost::multiprecision::detail::is_byte_container<Type> : boost::false_type {
};

namespace touchstone::oracle {

// Unbounded. Up to 1,024 bits need no heap memory, which covers bodies of similar size.
using Integer = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<1024, 0, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked,
                                           std::allocator<boost::multiprecision::limb_type>>,
    boost::multiprecision::et_off>;

using IntegerVector = std::array<Integer, 3>;

inline Integer dot(const IntegerVector& u, const IntegerVector& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
inline IntegerVector cross(const IntegerVector& u, const IntegerVector& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
inline IntegerVector operator+(const IntegerVector& u, const IntegerVector& v) {
  return {u[0] + v[0], u[1] + v[1], u[2] + v[2]};
}
inline IntegerVector operator-(const IntegerVector& u, const IntegerVector& v) {
  return {u[0] - v[0], u[1] - v[1], u[2] - v[2]};
}
inline IntegerVector operator-(const IntegerVector& u) { return {-u[0], -u[1], -u[2]}; }
inline IntegerVector operator*(const Integer& s, const IntegerVector& v) {
  return {s * v[0], s * v[1], s * v[2]};
}
inline bool is_zero(const IntegerVector& v) {
  return v[0].is_zero() && v[1].is_zero() && v[2].is_zero();
}

}  // namespace touchstone::oracle

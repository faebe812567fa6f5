// What a page has in it.
#pragma once

#include <zlib.h>

#include <boost/archive/iterators/binary_from_base64.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone {

inline std::string bytes_of(std::string_view base64) {
  namespace iterators = boost::archive::iterators;
  using Bytes = iterators::transform_width<iterators::binary_from_base64<const char*>, 8, 6>;
  std::size_t padding = 0;
  while (padding < base64.size() && base64[base64.size() - 1 - padding] == '=') ++padding;
  std::string text(base64);
  for (char& letter : text) {
    if (letter == '=') letter = 'A';
  }
  std::string bytes(Bytes(text.data()), Bytes(text.data() + text.size()));
  bytes.resize(text.size() / 4 * 3 - padding);
  return bytes;
}

template <class Number>
std::vector<Number> numbers_of(std::string_view base64) {
  const std::string bytes = bytes_of(base64);
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

// The numbers of frames that are written as differences.
inline std::vector<float> frames_of(std::string_view base64, std::size_t in_a_frame) {
  std::vector<std::uint32_t> bits = numbers_of<std::uint32_t>(base64);
  for (std::size_t i = in_a_frame; i < bits.size(); ++i) bits[i] ^= bits[i - in_a_frame];
  std::vector<float> numbers(bits.size());
  std::memcpy(numbers.data(), bits.data(), bits.size() * sizeof(float));
  return numbers;
}

// The bundle of a page that is nothing else.
inline nlohmann::json bundle_of(std::string_view base64) {
  const std::string packed = bytes_of(base64);
  std::string text(1 << 20, '\0');
  uLongf size = 0;
  int status = Z_BUF_ERROR;
  while (status == Z_BUF_ERROR) {
    text.resize(text.size() * 2);
    size = text.size();
    status = uncompress(reinterpret_cast<Bytef*>(text.data()), &size,
                        reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  }
  if (status != Z_OK) throw std::runtime_error("the page's data are no zlib stream");
  text.resize(size);
  return nlohmann::json::parse(text);
}

}  // namespace touchstone

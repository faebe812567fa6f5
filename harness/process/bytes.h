// Values as bytes, which another process of this program reads.
//
// A value is of a trivially copyable type, a string, a vector of values, or a class with a member
// `template <class Visit> void for_each_field(Visit visit)` that visits all its parts.
#pragma once

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace touchstone::process {

template <class T>
concept HasFields = requires(T& value) {
  value.for_each_field([](auto&) {});
};

class ByteWriter {
 public:
  template <class T>
  void add(const T& value) {
    if constexpr (HasFields<T>) {
      // add() only reads the value.
      const_cast<T&>(value).for_each_field([this](auto& field) { add(field); });
    } else {
      static_assert(std::is_trivially_copyable_v<T>);
      bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
  }
  template <class T>
  void add(const std::vector<T>& values) {
    add(values.size());
    for (const T& value : values) add(value);
  }
  void add(const std::string& text) {
    add(text.size());
    bytes_ += text;
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <class T>
  void read(T& value) {
    if constexpr (HasFields<T>) {
      value.for_each_field([this](auto& field) { read(field); });
    } else {
      static_assert(std::is_trivially_copyable_v<T>);
      std::memcpy(static_cast<void*>(&value), next(sizeof value).data(), sizeof value);
    }
  }
  template <class T>
  void read(std::vector<T>& values) {
    std::size_t size = 0;
    read(size);
    values.resize(size);
    for (T& value : values) read(value);
  }
  void read(std::string& text) {
    std::size_t size = 0;
    read(size);
    text = next(size);
  }

 private:
  std::string_view next(std::size_t size) {
    if (rest_.size() < size) throw std::logic_error("a result is cut short");
    const std::string_view bytes = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return bytes;
  }

  std::string_view rest_;
};

template <class T>
std::string to_bytes(const T& value) {
  ByteWriter writer;
  writer.add(value);
  return writer.take();
}

template <class T>
T from_bytes(std::string_view bytes) {
  T value{};
  ByteReader(bytes).read(value);
  return value;
}

}  // namespace touchstone::process

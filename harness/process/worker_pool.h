// Runs jobs in several processes and takes their results in order.
#pragma once

#include <cstddef>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace touchstone::process {

// Values as bytes, which another process of this program reads.
//
// A value is of a trivially copyable type, a string, a vector of values, or a class with a member
// `template <class Visit> void for_each_field(Visit visit)` that visits all its parts.

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
      const_cast<T&>(value).for_each_field([this](auto& field) { this->add(field); });
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
      value.for_each_field([this](auto& field) { this->read(field); });
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

// Runs the jobs first, first + 1, ... below `end` in `workers` forked processes. Each process calls
// `make` once, and the function that `make` returns for each of its jobs. The result, any bytes, is
// passed to `take` in this process, in the order of the jobs. When `take` returns false, no further
// job is begun and this result is the last. The caller must have no threads. A worker that throws
// or ends by itself causes a std::runtime_error here that names the job. The workers die with the
// caller.
using JobWork = std::function<std::string(std::size_t job)>;
void run_jobs(std::size_t first, std::size_t end, int workers, const std::function<JobWork()>& make,
              const std::function<bool(std::size_t job, std::string result)>& take);

// Runs jobs whose results are such values: `make` returns a function from a job to its
// result.
template <class Result, class Make, class Take>
void run_jobs(std::size_t first, std::size_t end, int workers, const Make& make, const Take& take) {
  run_jobs(
      first, end, workers,
      [&]() -> JobWork {
        return [work = make()](std::size_t job) { return to_bytes<Result>(work(job)); };
      },
      [&](std::size_t job, const std::string& bytes) {
        return take(job, from_bytes<Result>(bytes));
      });
}

}  // namespace touchstone::process

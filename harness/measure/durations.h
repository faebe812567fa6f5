// Seconds by name: the time of a sample, part by part.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

namespace touchstone::measure {

// Plain bytes without pointers, so that a worker process can send it.
class Durations {
 public:
  static constexpr std::size_t most = 6;           // names
  static constexpr std::size_t longest_name = 15;  // characters

  class Duration {
   public:
    double seconds = 0;
    std::string_view name() const { return name_.data(); }

   private:
    friend class Durations;
    std::array<char, longest_name + 1> name_{};
  };

  // Adds to the duration of that name, which begins at 0. Throws std::length_error if a name is too
  // long, or there are too many of them.
  void add(std::string_view name, double seconds);
  // Returns NaN if there is no duration of that name.
  double of(std::string_view name) const;
  double sum() const;
  // The durations in the order in which their names were added.
  std::span<const Duration> all() const { return {durations_.data(), count_}; }

 private:
  std::array<Duration, most> durations_{};
  std::size_t count_ = 0;
};

}  // namespace touchstone::measure

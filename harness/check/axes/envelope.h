// Where each algorithm breaks: the first value of each axis at which it gives up or is wrong.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/check/axes/stress_row.h"

namespace touchstone::check {

// Of one algorithm in one scalar along one axis, over all tasks.
struct Reach {
  std::uint32_t entry = 0;
  Precision scalar{};
  const StressAxis* axis = nullptr;
  // Of each outcome but right: the place of the first value at which there was one.
  std::array<std::optional<std::size_t>, grade::all_answer_classes.size()> first{};
  std::optional<std::size_t> first_side;  // the same of silent answers on the wrong side of contact
  std::int64_t answers = 0, skipped = 0;
  std::array<std::int64_t, grade::all_answer_classes.size()> counts{};
  double margin = Outcome::none, error = Outcome::none;  // the greatest; see StressRow

  std::optional<std::size_t> first_of(grade::AnswerClass outcome) const {
    return first[static_cast<std::size_t>(outcome)];
  }
};

// In the order of the request's algorithms, its scalars and its axes; none where the algorithm
// takes no pair of the axis. The request stays alive.
std::vector<Reach> envelope(const StressRequest& request, std::span<const StressRow> rows);

// Those of ours that broke the promise in double: silently wrong, crashed or hung; a line each.
std::vector<std::string> broken_promises(const StressRequest& request,
                                         std::span<const StressRow> rows);

// envelope.csv: a row for each reach.
void write_envelope(const StressRequest& request, std::span<const Reach> reaches,
                    const std::filesystem::path& file);

// A cell for each algorithm and axis: the first value at which it is silently wrong, crashes or
// hangs (wrong), or at which it says that it fails (honest); "-" where there is none, empty where
// the algorithm takes no pair of the axis. The first row is the header.
enum class EnvelopeTable : std::uint8_t { side, wrong, honest };
std::vector<std::vector<std::string>> table(const StressRequest& request,
                                            std::span<const Reach> reaches, EnvelopeTable which);

}  // namespace touchstone::check

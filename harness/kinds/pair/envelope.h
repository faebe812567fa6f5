// The envelope of an algorithm: for each axis, the first value at which it gives up, is wrong,
// crashes or hangs.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/base/table.h"
#include "harness/kinds/pair/axes/axes.h"
#include "harness/kinds/pair/pair_rows.h"

namespace touchstone::kinds {

// The outcomes of one algorithm in one scalar along one axis, over all tasks.
struct Reach {
  std::uint32_t entry = 0;
  Precision scalar{};
  const Axis* axis = nullptr;
  // The place of the first value with each outcome, except `right`.
  std::array<std::optional<std::size_t>, grade::all_answer_classes.size()> first{};
  std::optional<std::size_t> first_side;  // first silent answer on the wrong side of contact
  std::int64_t answers = 0, skipped = 0;
  std::array<std::int64_t, grade::all_answer_classes.size()> counts{};
  double margin = Outcome::none, error = Outcome::none;  // greatest values; see AxisCount

  std::optional<std::size_t> first_of(grade::AnswerClass outcome) const {
    return first[static_cast<std::size_t>(outcome)];
  }
};

// Returns the reaches in the order of the request's algorithms and its axes, without
// those of algorithms that take no pair of the axis. The request must outlive the result.
std::vector<Reach> envelope(const PairRequest& request, std::span<const AxisCount> rows);

// Writes envelope.csv: one row for each reach.
void write_envelope(const PairRequest& request, std::span<const AxisCount> rows,
                    const std::filesystem::path& file);

// Returns a table with a cell for each algorithm and axis: the first value at which it is silently
// wrong, crashes or hangs (wrong), is so on the side of contact (side), or reports a failure
// (honest). A cell is "-" if there is no such value, and empty if the algorithm takes no pair of
// the axis.
enum class EnvelopeTable : std::uint8_t { side, wrong, honest };
base::Table table(const PairRequest& request, std::span<const Reach> reaches, EnvelopeTable which);

}  // namespace touchstone::kinds

// Asks the oracle that is for the pairs of a set, writes reproductions, and sorts the rows of a
// check pass.
#include "harness/campaign/check_pass.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "harness/base/error.h"
#include "harness/record/folder_files.h"

namespace touchstone::campaign {
namespace {

std::string key(const std::string& broad, std::string_view task, const std::string& kind) {
  return broad + "|" + std::string(task) + "|" + kind;
}

std::uint64_t from_hex(const std::string& text) {
  std::uint64_t value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return value;
}

}  // namespace

std::string set_key(const measure::NarrowSet& set) {
  return key(set.broad, to_string(set.task), set.kind_name());
}

std::string set_key(const record::RawRow& row) {
  return row.narrow.empty() ? "" : key(row.broad, to_string(*row.task), row.pair_kind);
}

double Checked::greatest_seconds() const { return seconds.empty() ? 0 : std::ranges::max(seconds); }

CheckTable::CheckTable(std::span<const record::RawRow> rows, std::int64_t block,
                       std::size_t frames) {
  for (const record::RawRow& row : rows) {
    if (row.block != block || row.kind != record::RowKind::check || row.process >= 0) continue;
    if (row.phase == record::Phase::convert) continue;  // a part of the build or the update
    if (row.status == record::RowStatus::unsupported) continue;
    const auto frame = static_cast<std::size_t>(row.frame);
    if (frame >= frames) continue;
    Checked& checked = table_[{record::label_of(row), set_key(row)}];
    if (checked.pairs.empty()) {
      checked.pairs.resize(frames);
      checked.hash.resize(frames);
      checked.seconds.resize(frames);
      checked.disagreements.resize(frames);
    }
    if (row.lost() || row.wrong()) checked.out = true;
    if (row.seconds >= 0) checked.seconds[frame] += row.seconds;
    if (row.pair_count >= 0) checked.pairs[frame] = row.pair_count;
    const std::string& hash = row.narrow.empty() ? row.pair_hash : row.outcome_hash;
    if (!hash.empty()) checked.hash[frame] = from_hex(hash);
    if (row.disagreements >= 0) checked.disagreements[frame] = row.disagreements;
    checked.gave_up = checked.gave_up || row.status == record::RowStatus::not_converged;
  }
}

const Checked* CheckTable::find(const std::string& label, const measure::NarrowSet* set) const {
  auto at = table_.find({label, set == nullptr ? "" : set_key(*set)});
  if (at == table_.end() && set != nullptr) {
    at = table_.find({label, key("", to_string(set->task), set->kind_name())});
  }
  return at == table_.end() ? nullptr : &at->second;
}

ExactAnswers::ExactAnswers(const measure::BlockInput& input)
    : input_(&input), convex_(input.shapes, executor_) {
  if (!input.bodies.empty()) concave_.emplace(input.bodies);
}

std::string ExactAnswers::key(const measure::NarrowSet& set) {
  const std::string of_pairs = set.broad + "|" + set.kind_name();
  return set.is_concave() ? of_pairs + "|" + std::string(to_string(set.task)) : of_pairs;
}

std::vector<grade::ReferenceOutcome> ExactAnswers::solve(const measure::NarrowSet& set,
                                                         std::size_t frame) {
  const measure::BlockFrame& at = input_->frames[frame];
  const grade::PairGroup& pairs = set.frames[frame];
  if (!set.is_concave()) return convex_.solve(pairs, input_->shape_of, at.poses);
  return concave_->solve(*record::concave_task(set.task), pairs, input_->shape_of, at.poses,
                         at.boxes);
}

void write_reproduction(const RunContext& context, std::string_view text, std::string_view ending,
                        const std::function<void(const std::filesystem::path&)>& write,
                        record::Departure& departure) {
  if (context.results.empty()) return;
  try {
    record::OwnFiles own(context.results);
    std::filesystem::path file = own.free_stem(
        std::filesystem::path("reproductions") / fmt::format("block-{}", context.number), text);
    file += ending;
    own.note({file});
    write(file);
    departure.reproduction = file.string();
  } catch (const base::InputError& error) {
    departure.what += fmt::format("; without a file that shows it: {}", error.what());
  }
}

}  // namespace touchstone::campaign

#include "harness/record/raw_row.h"

#include <fmt/core.h>

#include <array>
#include <cmath>

namespace touchstone {
namespace {

constexpr std::array all_phases = {Phase::build, Phase::update, Phase::find_pairs, Phase::narrow,
                                   Phase::convert};
constexpr std::array all_row_kinds = {RowKind::check, RowKind::sample};

// Calls visit(column name, field) for each column in order: the header, what is written and what is
// read cannot differ.
template <class Row, class Visit>
void columns(Row& row, Visit visit) {
  visit("campaign", row.campaign);
  visit("kind", row.kind);
  visit("block", row.block);
  visit("scene", row.scene);
  visit("scene_hash", row.scene_hash);
  visit("seed", row.seed);
  visit("bodies", row.bodies);
  visit("boxes", row.boxes);
  visit("frame", row.frame);
  visit("frames", row.frames);
  visit("broad", row.broad);
  visit("narrow", row.narrow);
  visit("scalar", row.scalar);
  visit("task", row.task);
  visit("tolerance", row.tolerance);
  visit("duality_gap", row.duality_gap);
  visit("twin", row.twin);
  visit("threads", row.threads);
  visit("isa", row.isa);
  visit("isa_limit", row.isa_limit);
  visit("rebuild", row.rebuild);
  visit("pair_kind", row.pair_kind);
  visit("process", row.process);
  visit("square", row.square);
  visit("round", row.round);
  visit("position", row.position);
  visit("phase", row.phase);
  visit("seconds", row.seconds);
  visit("pair_count", row.pair_count);
  visit("pair_hash", row.pair_hash);
  visit("contact_count", row.contact_count);
  visit("outcome_hash", row.outcome_hash);
  visit("compared", row.compared);
  visit("disagreements", row.disagreements);
  visit("worst_disagreement", row.worst_disagreement);
  visit("worst_error", row.worst_error);
  visit("failures", row.failures);
  visit("iterations", row.iterations);
  visit("iterations_squared", row.iterations_squared);
  visit("support_calls", row.support_calls);
  visit("box_tests", row.box_tests);
  visit("node_visits", row.node_visits);
  visit("candidates", row.candidates);
  visit("bytes", row.bytes);
  visit("allocations", row.allocations);
  visit("allocated_bytes", row.allocated_bytes);
  visit("peak_kb", row.peak_kb);
  visit("minor_faults", row.minor_faults);
  visit("voluntary_switches", row.voluntary_switches);
  visit("involuntary_switches", row.involuntary_switches);
  visit("waited", row.waited);
  visit("cycles", row.cycles);
  visit("instructions", row.instructions);
  visit("branch_misses", row.branch_misses);
  visit("cache_misses", row.cache_misses);
  visit("status", row.status);
  visit("noise", row.noise);
  visit("words", row.words);
  visit("stop", row.stop);
  visit("warm", row.warm);
}

struct Names {
  std::vector<std::string>& names;
  template <class Value>
  void operator()(const char* name, const Value&) const {
    names.emplace_back(name);
  }
};

struct Fields {
  CsvWriter& file;
  void operator()(const char*, const std::string& text) const { file.field(text); }
  void operator()(const char*, Phase phase) const { file.field(to_string(phase)); }
  void operator()(const char*, RowKind kind) const { file.field(to_string(kind)); }
  void operator()(const char*, double value) const { file.field(value); }
  void operator()(const char*, std::int64_t value) const {
    if (value < 0) {
      file.field("");
    } else {
      file.field(value);
    }
  }
};

struct Parse {
  const CsvReader::Row& row;
  std::size_t& column;
  void operator()(const char*, std::string& text) { text = row.text(column++); }
  void operator()(const char*, Phase& phase) { choose(all_phases, phase); }
  void operator()(const char*, RowKind& kind) { choose(all_row_kinds, kind); }
  void operator()(const char*, double& value) {
    value = row.text(column).empty() ? Outcome::none : row.number(column);
    ++column;
  }
  void operator()(const char*, std::int64_t& value) {
    value = row.text(column).empty() ? -1 : row.integer(column);
    ++column;
  }
  template <class Choices, class Choice>
  void choose(const Choices& choices, Choice& chosen) {
    const std::string_view text = row.text(column++);
    for (const Choice choice : choices) {
      if (to_string(choice) == text) {
        chosen = choice;
        return;
      }
    }
    row.fail(fmt::format("found '{}'; expected a phase or kind of row", text));
  }
};

}  // namespace

std::string_view to_string(Phase phase) {
  switch (phase) {
    case Phase::build: return "build";
    case Phase::update: return "update";
    case Phase::find_pairs: return "find_pairs";
    case Phase::narrow: return "narrow";
    case Phase::convert: return "convert";
  }
  return "?";
}

std::string_view to_string(RowKind kind) { return kind == RowKind::check ? "check" : "sample"; }

void RawRow::take(const BroadPhaseWork& work) {
  box_tests = work.box_tests;
  node_visits = work.node_visits;
  candidates = work.candidates;
  bytes = work.bytes;
}

std::string narrow_label(std::string_view name, std::string_view scalar, double tolerance,
                         double duality_gap, bool warm) {
  std::string label = fmt::format("{} {}", name, scalar);
  if (!std::isnan(tolerance)) label += fmt::format(" {:g}", tolerance);
  if (!std::isnan(duality_gap)) label += fmt::format(" gap {:g}", duality_gap);
  if (warm) label += " warm";
  return label;
}

std::string label_of(const RawRow& row) {
  if (row.narrow.empty()) return row.broad;
  return narrow_label(row.narrow, row.scalar, row.tolerance, row.duality_gap, row.warm == 1);
}

std::vector<std::string> raw_header() {
  std::vector<std::string> names;
  const RawRow row;
  columns(row, Names{names});
  return names;
}

void write(CsvWriter& file, const RawRow& row) {
  columns(row, Fields{file});
  file.end_row();
}

std::vector<RawRow> read_raw_rows(const std::filesystem::path& file) {
  std::vector<RawRow> rows;
  CsvReader(file, raw_header()).read([&](const CsvReader::Row& fields) {
    std::size_t column = 0;
    columns(rows.emplace_back(), Parse{fields, column});
  });
  return rows;
}

}  // namespace touchstone

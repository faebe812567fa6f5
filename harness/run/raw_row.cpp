#include "harness/run/raw_row.h"

#include <fmt/core.h>

#include <cmath>

#include "algorithms/core/isa.h"

namespace touchstone {
namespace {

// Calls visit(column name, value) for each column in order: the header and the rows cannot differ.
template <class Visit>
void columns(const RawRow& row, const std::string& campaign, Visit visit) {
  visit("campaign", campaign);
  visit("scene", row.scene);
  visit("scene_hash", row.scene_hash);
  visit("bodies", row.bodies);
  visit("boxes", row.boxes);
  visit("frame", std::int64_t{row.frame});
  visit("broad", row.broad);
  visit("narrow", row.narrow);
  visit("scalar", row.scalar);
  visit("task", row.task);
  visit("tolerance", row.tolerance);
  visit("threads", std::int64_t{row.threads});
  visit("isa", std::string(to_string(isa())));
  visit("pair_kind", row.pair_kind);
  visit("phase", std::string(to_string(row.phase)));
  visit("seconds", row.seconds);
  visit("pair_count", row.pair_count);
  visit("pair_hash", row.pair_hash);
  visit("contact_count", row.contact_count);
  visit("outcome_hash", row.outcome_hash);
  visit("disagreements", row.disagreements);
  visit("worst_disagreement", row.worst_disagreement);
  visit("failures", row.failures);
  visit("status", row.status);
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
  void operator()(const char*, double value) const { file.field(value); }
  void operator()(const char*, std::int64_t value) const {
    if (value < 0) {
      file.field("");
    } else {
      file.field(value);
    }
  }
};

}  // namespace

std::string_view to_string(Phase phase) {
  switch (phase) {
    case Phase::build: return "build";
    case Phase::update: return "update";
    case Phase::find_pairs: return "find_pairs";
    case Phase::narrow: return "narrow";
  }
  return "?";
}

std::string narrow_label(std::string_view name, std::string_view scalar, double tolerance) {
  std::string label = fmt::format("{} {}", name, scalar);
  if (!std::isnan(tolerance)) label += fmt::format(" {:g}", tolerance);
  return label;
}

std::vector<std::string> raw_header() {
  std::vector<std::string> names;
  columns(RawRow{}, "", Names{names});
  return names;
}

void write(CsvWriter& file, const RawRow& row, const std::string& campaign) {
  columns(row, campaign, Fields{file});
  file.end_row();
}

}  // namespace touchstone

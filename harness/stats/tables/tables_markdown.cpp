// Writes the tables as Markdown, and all tables as files.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "harness/base/table.h"
#include "harness/files/text_file.h"
#include "harness/stats/tables/table_rows.h"

namespace touchstone::stats {
namespace {

// What is said of a depth that is an upper bound by design.
template <class Row>
std::string_view bound_words(const Row& row) {
  const bool is_depth = row.key.task == "penetration" || row.key.task == "signed";
  return row.depth_is_bound && is_depth ? " (a bound)" : "";
}

std::string remark(const TimeRow& row, double depth_error) {
  std::vector<std::string> words;
  if (row.wrong) words.emplace_back("**wrong on some**");
  if (row.worst_error > depth_error)
    words.push_back(fmt::format("**off by {:.1g}**{}", row.worst_error, bound_words(row)));
  if (row.unknown > 0) words.push_back(fmt::format("{} of {} unknown", row.unknown, row.queries));
  if (!row.failure.empty()) words.push_back(row.failure);
  if (row.noisy > 0) words.push_back(fmt::format("{} of {} noisy", row.noisy, row.samples));
  if (row.outliers > 0) words.push_back(fmt::format("{} outliers", row.outliers));
  return fmt::format("{}", fmt::join(words, ", "));
}

// Returns the times of one set, each beside its ratio to the baseline.
std::string set_table(const Tables& tables, std::size_t begin, std::size_t end) {
  const TimeRow& first = tables.times[begin];
  const bool broad = !first.key.narrow();
  const double scale = broad ? 1e3 : 1e9;
  std::vector<std::string> names = {"", broad ? "ms a frame" : "ns a query", "95 % interval",
                                    "minimum"};
  if (broad)
    names.insert(names.end(), {"worst frame", "build", "update", "(converting)", "find pairs"});
  names.insert(names.end(), {"ratio", "95 % interval", "squares", "remarks"});
  base::Table table(std::move(names));
  std::string baseline;
  std::string canary;
  const auto ratio_of = [&](const std::string& label, bool of_twin) -> const RatioRow* {
    const auto at = std::ranges::find_if(tables.ratios, [&](const RatioRow& row) {
      return row.key == first.key && row.label == label && row.canary == of_twin;
    });
    return at == tables.ratios.end() ? nullptr : &*at;
  };
  for (std::size_t i = begin; i < end; ++i) {
    const TimeRow& row = tables.times[i];
    std::vector<std::string> cells = {row.label, base::cell(row.seconds.median * scale),
                                      interval_cell(row.seconds, scale),
                                      base::cell(row.minimum * scale)};
    if (broad) {
      cells.push_back(base::cell(row.worst_frame * scale));
      for (const record::Phase part : {record::Phase::build, record::Phase::update,
                                       record::Phase::convert, record::Phase::find_pairs}) {
        cells.push_back(base::cell(row.parts[static_cast<std::size_t>(part)] * scale));
      }
    }
    if (const RatioRow* const ratio = ratio_of(row.label, false)) {
      baseline = ratio->baseline;
      const MedianInterval known = if_known(ratio->ratio);
      cells.insert(cells.end(), {base::cell(known.median), interval_cell(known)});
    } else {
      cells.insert(cells.end(), {row.samples > 0 ? "1" : "-", "-"});
    }
    cells.push_back(std::to_string(row.seconds.n));
    cells.push_back(remark(row, tables.depth_error));
    table.add(std::move(cells));
    if (const RatioRow* const twin = ratio_of(row.label, true)) {
      const bool told_apart = twin->ratio.low > 1 || twin->ratio.high < 1;
      canary =
          fmt::format("The canary, {} against itself: {}, {}{}.\n", row.label,
                      base::cell(twin->ratio.median), interval_cell(twin->ratio),
                      twin->suspect ? " (**told apart** by more than the campaign's width: this "
                                      "table is **suspect**)"
                      : told_apart  ? " (**told apart**: trust no smaller difference)"
                                    : "");
    }
  }
  std::string all = fmt::format("### {}\n\n", first.key.words());
  if (!baseline.empty()) all += fmt::format("Ratios are to {}. ", baseline);
  if (!baseline.empty() || !canary.empty()) all += canary + "\n";
  return all + table.markdown() + "\n";
}

// Sums over the inputs and kinds of pairs, whose details are in agreement.csv.
std::vector<AgreementRow> by_task(const std::vector<AgreementRow>& rows) {
  std::vector<AgreementRow> sums;
  for (const AgreementRow& row : rows) {
    auto at = std::ranges::find_if(sums, [&](const AgreementRow& sum) {
      return sum.key.task == row.key.task && sum.label == row.label;
    });
    if (at == sums.end()) {
      at = sums.insert(sums.end(), {row.key, row.label, row.origin});
      at->depth_is_bound = row.depth_is_bound;
    }
    at->queries += row.queries;
    at->right += row.right;
    at->wrong += row.wrong;
    at->failed += row.failed;
    at->unanswered += row.unanswered;
    at->worst_error = std::fmax(at->worst_error, row.worst_error);
  }
  std::ranges::stable_sort(sums, {}, [](const AgreementRow& sum) { return sum.key.task; });
  return sums;
}

// Means for a query over the inputs and kinds of pairs, whose details are in work.csv.
class MeanWork {
 public:
  explicit MeanWork(const WorkRow& row) : row_(row) {}
  bool is_of(const WorkRow& row) const {
    return row.key.task == row_.key.task && row.label == row_.label;
  }
  void add(const WorkRow& row) {
    const std::array values = {row.iterations, row.support_calls, row.allocations,
                               row.allocated_bytes};
    const auto queries = static_cast<double>(row.queries);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isnan(values[i])) continue;
      sums_[i] += values[i] * queries;
      queries_[i] += queries;
    }
  }
  const std::string& task() const { return row_.key.task; }
  std::vector<std::string> cells() const {
    std::vector<std::string> all = {task(), row_.label};
    for (std::size_t i = 0; i < sums_.size(); ++i)
      all.push_back(base::cell(sums_[i] / queries_[i]));
    return all;
  }

 private:
  WorkRow row_;  // the first row
  std::array<double, 4> sums_{}, queries_{};
};

// Work is counted at one thread for all sets, so each input has one table.
std::string work_tables(const std::vector<WorkRow>& rows) {
  std::string all;
  std::vector<SetKey> told;
  std::vector<MeanWork> narrow;
  for (const WorkRow& first : rows) {
    if (first.key.narrow()) {
      auto mean = std::ranges::find_if(narrow, [&](const MeanWork& m) { return m.is_of(first); });
      if (mean == narrow.end()) mean = narrow.insert(mean, MeanWork(first));
      mean->add(first);
      continue;
    }
    SetKey input = first.key;
    input.threads = 1;
    if (std::ranges::find(told, input) != told.end()) continue;
    told.push_back(input);
    all += fmt::format("### {}\n\n", input.words());
    base::Table table({"", "box tests / body", "node visits / body", "candidates / pair",
                       "bytes / body", "allocations / frame", "bytes allocated / frame"});
    for (const WorkRow& row : rows) {
      if (row.key != first.key) continue;
      table.add({row.label, base::cell(row.box_tests), base::cell(row.node_visits),
                 base::cell(row.candidates), base::cell(row.bytes), base::cell(row.allocations),
                 base::cell(row.allocated_bytes)});
    }
    all += table.markdown() + "\n";
  }
  if (!narrow.empty()) {
    all += "### Narrow phases, over all inputs\n\n";
    base::Table table({"task", "", "iterations / query", "support calls / query",
                       "allocations / query", "bytes allocated / query"},
                      2);
    std::ranges::stable_sort(narrow, {}, &MeanWork::task);
    for (const MeanWork& mean : narrow) table.add(mean.cells());
    all += table.markdown() + "\n";
  }
  if (all.empty()) return all;
  return "## Work\n\nCounted over the verified frames; it does not depend on the machine. "
         "Allocations are those of\nthe second playing, when what is kept is there.\n\n" +
         all;
}

// A row needs a peer or a limit to be compared with.
std::string broad_best_table(const std::vector<BroadBestRow>& rows) {
  base::Table table({"input", "ours", "peer", "of Bullet and FCL", "ours, ms", "peer, ms",
                     "peer / ours", "95 % interval", "Bullet or FCL, ms", "/ ours", "95 % interval",
                     "ours / limit", "bytes / body", "speed-up", "growth", "worst / median"},
                    4);
  const auto name = [](const std::string& label) {
    return label.empty() ? "none is right" : label;
  };
  for (const BroadBestRow& row : rows) {
    if (row.peer.label.empty() && std::isnan(row.over_limit.median)) continue;
    table.add({row.key.words(), row.ours.label, name(row.peer.label), name(row.bullet_or_fcl.label),
               base::cell(row.ours.seconds * 1e3), base::cell(row.peer.seconds * 1e3),
               base::cell(row.peer.ratio.median), interval_cell(row.peer.ratio),
               base::cell(row.bullet_or_fcl.seconds * 1e3),
               base::cell(row.bullet_or_fcl.ratio.median), interval_cell(row.bullet_or_fcl.ratio),
               base::cell(row.over_limit.median), base::cell(row.bytes_a_body),
               base::cell(row.speed_up.median), base::cell(row.exponent),
               base::cell(row.worst_frame / row.ours.seconds)});
  }
  if (table.is_empty()) return "";
  return "## The best of our broad phases against the best of others\n\nMilliseconds a frame; "
         "ratios are of the other's time over that of ours. The limit is a radix sort, a gather\n"
         "of the boxes and the writing of the pairs. Speed-up is over the fewest threads, growth "
         "the exponent of\ntime over bodies where there are many. Worst is the longest frame of "
         "ours, over its median.\n\n" +
         table.markdown() + "\n";
}

std::string narrow_best_table(const std::vector<NarrowBestRow>& rows, double depth_error) {
  base::Table table(
      {"input", "ours", "right peer", "fastest peer", "ours, ns", "error", "right peer, ns",
       "error", "/ ours", "95 % interval", "fastest peer, ns", "wrong", "error", "/ ours"},
      4);
  const auto error = [](const NarrowBestRow::Best& best) {
    return std::isnan(best.worst_error) ? std::string("-")
                                        : fmt::format("{:.0e}", best.worst_error);
  };
  const auto name = [](const NarrowBestRow::Best& best) {
    return best.label.empty() ? "no library is right" : best.label;
  };
  for (const NarrowBestRow& row : rows) {
    if (row.any_peer.label.empty()) continue;
    table.add({row.key.words(), row.ours.label, name(row.right_peer), name(row.any_peer),
               base::cell(row.ours.seconds * 1e9), error(row.ours),
               base::cell(row.right_peer.seconds * 1e9), error(row.right_peer),
               base::cell(row.right_peer.ratio.median), interval_cell(row.right_peer.ratio),
               base::cell(row.any_peer.seconds * 1e9),
               fmt::format("{} of {}", row.any_peer.wrong, row.any_peer.queries),
               error(row.any_peer), base::cell(row.any_peer.ratio.median)});
  }
  if (table.is_empty()) return "";
  return fmt::format(
             "## Speed and error of the best narrow phases\n\nNanoseconds a query; ratios are of "
             "the other's time over that of ours. Right is an algorithm\nwith no wrong answer and "
             "no distance or depth off by more than {} of the pair's size; errors are the "
             "greatest,\nas parts of it.\n\n",
             depth_error) +
         table.markdown() + "\n";
}

}  // namespace

std::string tables_markdown(const Tables& tables) {
  std::string all = fmt::format("# Tables of the campaign {}\n\n", tables.campaign);
  for (const std::string& fact : tables.machine) all += fmt::format("- {}\n", fact);
  all +=
      "\nTimes are medians over squares, intervals those of the sign test at 95 %. A ratio is the "
      "median of\npaired log ratios. `-`: "
      "fewer than six undisturbed squares, too few to tell (four in tables of the best).\n\n";
  if (!tables.winners.empty() || tables.undecided > 0) {
    all += "## Winner against runner-up\n\n";
    base::Table table({"input", "winner", "runner-up", "runner-up / winner", "95 % interval"}, 3);
    for (const WinnerRow& row : tables.winners) {
      const bool tie = row.is_tie();
      table.add({row.key.words() + (row.suspect ? " (**suspect**)" : ""),
                 tie ? row.winner + " = " + row.runner_up : row.winner, tie ? "-" : row.runner_up,
                 base::cell(row.ratio.median), interval_cell(row.ratio)});
    }
    if (!table.is_empty()) all += table.markdown() + "\n";
    if (tables.undecided > 0) {
      all += fmt::format("No winner in {} more: fewer than six undisturbed squares.\n\n",
                         tables.undecided);
    }
  }
  all += broad_best_table(tables.broad_best);
  all += narrow_best_table(tables.narrow_best, tables.depth_error);
  if (!tables.exponents.empty()) {
    all += "## Scaling: time grows as bodies to the power of\n\n";
    base::Table table({"input", "algorithm", "exponent", "95 % interval", "counts",
                       fmt::format("from {} on", many_bodies)},
                      2);
    for (const ExponentRow& row : tables.exponents) {
      table.add(
          {fmt::format("{}, {} boxes, {} thread{}{}{}", row.key.scene, row.key.boxes,
                       row.key.threads, row.key.threads == 1 ? "" : "s",
                       row.key.isa_limit.empty() ? "" : ", " + row.key.isa_limit + " instructions",
                       row.key.rebuild ? ", rebuilt" : ""),
           row.label, fmt::format("{:.2f}", row.law.exponent),
           std::isnan(row.law.low) ? std::string("-")
                                   : fmt::format("{:.2f} to {:.2f}", row.law.low, row.law.high),
           fmt::format("{}", fmt::join(row.counts, ", ")),
           std::isnan(row.law_of_many.exponent) ? std::string("-")
                                                : fmt::format("{:.2f}", row.law_of_many.exponent)});
    }
    all += table.markdown() + "\n";
  }
  if (!tables.speed_ups.empty()) {
    all += "## Speed-up by threads\n\n";
    base::Table table({"input", "algorithm", "over threads", "speed-up", "95 % interval"}, 2);
    for (const SpeedUpRow& row : tables.speed_ups) {
      table.add({row.key.words(), row.label, std::to_string(row.base_threads),
                 base::cell(row.speed_up.median), interval_cell(row.speed_up)});
    }
    all += table.markdown() + "\n";
  }
  if (!tables.executors.empty()) {
    all += "## Executors\n\n";
    base::Table table({"input", "algorithm", "executor", "over", "ratio", "95 % interval"}, 4);
    for (const ExecutorRow& row : tables.executors) {
      table.add({row.key.words() + (row.suspect ? " (**suspect**)" : ""), row.algorithm,
                 std::string(to_string(row.executor)), std::string(to_string(row.base)),
                 base::cell(row.ratio.median), interval_cell(row.ratio)});
    }
    all += table.markdown() + "\n";
  }
  if (!tables.agreement.empty()) {
    all += fmt::format(
        "## Agreement with the exact answers\n\nRight and wrong are sides of contact. The worst "
        "error is that of a distance or depth, as a part of the\npair's size; **more than {}** is "
        "no agreement, and wins no table.\n\n",
        tables.depth_error);
    base::Table table(
        {"task", "algorithm", "queries", "right", "wrong", "failed", "unanswered", "worst error"},
        2);
    for (const AgreementRow& row : by_task(tables.agreement)) {
      table.add({row.key.task, row.label, std::to_string(row.queries), std::to_string(row.right),
                 std::to_string(row.wrong), std::to_string(row.failed),
                 std::to_string(row.unanswered),
                 row.worst_error > tables.depth_error
                     ? fmt::format("**{:.4g}**{}", row.worst_error, bound_words(row))
                     : base::cell(row.worst_error)});
    }
    all += table.markdown() + "\n";
  }
  all += work_tables(tables.work);
  all += "## Times\n\n";
  for (std::size_t begin = 0; begin < tables.times.size();) {
    std::size_t end = begin;
    while (end < tables.times.size() && tables.times[end].key == tables.times[begin].key) ++end;
    all += set_table(tables, begin, end);
    begin = end;
  }
  return all;
}

void write_tables(const Tables& tables, double band, const std::filesystem::path& folder) {
  record::write_rows(folder / "times.csv", tables.times);
  record::write_rows(folder / "ratios.csv", tables.ratios, band);
  record::write_rows(folder / "library_ratios.csv", tables.library_ratios, band);
  record::write_rows(folder / "winners.csv", tables.winners);
  record::write_rows(folder / "exponents.csv", tables.exponents);
  record::write_rows(folder / "speed_ups.csv", tables.speed_ups);
  record::write_rows(folder / "executors.csv", tables.executors);
  record::write_rows(folder / "agreement.csv", tables.agreement);
  record::write_rows(folder / "work.csv", tables.work);
  record::write_rows(folder / "broad_best.csv", tables.broad_best);
  record::write_rows(folder / "narrow_best.csv", tables.narrow_best);
  files::write_text(folder / "tables.md", tables_markdown(tables));
}

}  // namespace touchstone::stats

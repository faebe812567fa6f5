// Writes two tables as Markdown: the best of our broad phases and of our narrow phases, each
// against the best library. Used by tables_markdown.cpp.
#include "harness/stats/tables/best_markdown.h"

#include <fmt/format.h>

#include <cmath>

#include "harness/base/table.h"

namespace touchstone::stats {

// A row needs a peer or a limit to be compared with.
std::string broad_best_table(const std::vector<BroadBestRow>& rows) {
  base::Table table({"input", "ours", "peer", "of Bullet and FCL", "ours, ms", "peer, ms",
                     "peer / ours", "95 % interval", "Bullet or FCL, ms", "/ ours", "95 % interval",
                     "ours / limit", "bytes / body", "speed-up", "growth", "worst / median"},
                    4);
  const auto name = [](const std::string& label) { return label.empty() ? "-" : label; };
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
    return best.label.empty() ? "-" : best.label;
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

}  // namespace touchstone::stats

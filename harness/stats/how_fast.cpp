// Compares the fastest of ours with the fastest library in each input, and counts who leads.
#include "harness/stats/how_fast.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <ranges>
#include <string_view>

#include "harness/stats/summary_words.h"
#include "harness/stats/tables/table_parts.h"

namespace touchstone::stats {
namespace {

constexpr std::size_t most_scenes = 4;  // with rows of their own; algorithms of the user too

std::string_view question_of(std::string_view task) {
  if (task.empty()) return "Which boxes overlap";
  if (task == "intersect") return "Do two bodies touch";
  if (task == "distance") return "How far apart";
  if (task == "penetration") return "How deep";
  return task == "signed" ? "How far, or how deep" : "Where do they touch";
}

enum class Side : std::uint8_t { faster, slower, unclear, no_library };

// The fastest of ours against the fastest library, in a set and batch; only those that are right.
struct Duel {
  const SetKey* key = nullptr;
  std::int64_t batch = -1;
  Side side = Side::unclear;
  bool asks_libraries = false;
  std::string ours, library;                  // empty: none is right
  MedianInterval ratio = {nan, nan, nan, 0};  // the library's time over that of ours, if trusted
  double queries = 1, seconds = nan;          // of ours; `seconds` for one of them

  std::string question() const {
    return fmt::format("{}{}", question_of(key->task),
                       batch > 0 ? fmt::format(", {} a call", batch) : "");
  }
  std::string names() const {
    if (side == Side::slower) return short_label(library) + " leads " + short_label(ours);
    if (side == Side::no_library || library.empty()) return short_label(ours);
    return short_label(ours) + (side == Side::faster ? " leads " : " = ") + short_label(library);
  }
};
using Duels = std::vector<const Duel*>;

// Fills in what a row of the tables of the best says.
template <class Best>
void take(const Best& ours, const Best& library, bool suspect, Duel& duel, Doubts& doubts) {
  duel.ours = ours.label;
  duel.library = library.label;
  duel.seconds = ours.seconds;
  if (library.label.empty()) {
    duel.side = Side::no_library;
  } else if (!suspect) {
    duel.ratio = if_known(library.ratio);
    duel.side = duel.ratio.low > 1    ? Side::faster
                : duel.ratio.high < 1 ? Side::slower
                                      : Side::unclear;
    doubts.few_squares += std::isnan(duel.ratio.median);
  }
}

std::vector<Duel> duels_of(const Results& results, const Tables& tables, Doubts& doubts) {
  std::vector<Duel> duels;
  for (const SampleSet& set : results.sets) {
    for (const std::int64_t batch : batches_of(set)) {
      const auto is_timed = [&](const Contestant& contestant) {
        return contestant.batch == batch && !contestant.samples.empty();
      };
      if (std::ranges::none_of(set.contestants, is_timed)) continue;
      ++doubts.inputs;
      if (set.suspect) {
        doubts.suspect.push_back(
            set.key.scene + " " +
            (set.key.narrow() ? set.key.task + " " + set.key.pair_kind : "boxes"));
      }
      if (std::ranges::none_of(set.contestants, [&](const Contestant& contestant) {
            return contestant.is_ours() && is_timed(contestant);
          })) {
        continue;
      }
      Duel& duel = duels.emplace_back();
      duel.key = &set.key;
      duel.batch = batch;
      duel.asks_libraries = std::ranges::any_of(set.contestants, [&](const Contestant& contestant) {
        return contestant.batch == batch && contestant.origin == record::RowOrigin::peer;
      });
      const auto narrow = std::ranges::find_if(tables.narrow_best, [&](const NarrowBestRow& row) {
        return row.key == set.key && row.batch == batch;
      });
      const auto broad = std::ranges::find(tables.broad_best, set.key, &BroadBestRow::key);
      if (narrow != tables.narrow_best.end()) {
        take(narrow->ours, narrow->right_peer, set.suspect, duel, doubts);
        duel.queries = static_cast<double>(narrow->ours.queries);
      } else if (broad != tables.broad_best.end()) {
        take(broad->ours, broad->peer, set.suspect, duel, doubts);
      } else {
        ++doubts.none_of_ours;
      }
    }
  }
  return duels;
}

// Returns the ratio of the time of all queries. Its interval takes the errors as independent.
MedianInterval by_pairs(const Duels& duels) {
  double time = 0, sum = 0, below = 0, above = 0;
  for (const Duel* duel : duels) {
    if (std::isnan(duel->ratio.median)) continue;
    const double weight = duel->queries * duel->seconds;
    time += weight;
    sum += weight * duel->ratio.median;
    below += std::pow(weight * (duel->ratio.median - duel->ratio.low), 2);
    above += std::pow(weight * (duel->ratio.high - duel->ratio.median), 2);
  }
  if (time == 0) return {nan, nan, nan, 0};
  return {sum / time, (sum - std::sqrt(below)) / time, (sum + std::sqrt(above)) / time,
          duels.size()};
}

std::string line_of(std::string_view name, const Duels& duels, std::string_view tail) {
  const auto count = [&](Side side) { return std::ranges::count(duels, side, &Duel::side); };
  return fmt::format("{:<28}{:>7}{:>9}{:>8}{:>9}{:>18}{}{}\n", name, duels.size(),
                     count(Side::faster), count(Side::slower), count(Side::unclear),
                     count(Side::no_library), tail.empty() ? "" : "   ", tail);
}

std::vector<const Duel*> known_of(const Duels& duels) {
  Duels known;
  std::ranges::copy_if(duels, std::back_inserter(known),
                       [](const Duel* duel) { return !std::isnan(duel->ratio.median); });
  std::ranges::sort(known, {}, [](const Duel* duel) { return duel->ratio.median; });
  return known;
}

// The inputs of one question: the middle ratio with its interval, and the ends of all.
std::string question_line(const std::string& name, const Duels& duels) {
  const Duels known = known_of(duels);
  std::string tail = "-";
  if (known.size() == 1) tail = ratio_text(known[0]->ratio);
  if (known.size() > 1) {
    const MedianInterval& a = known[(known.size() - 1) / 2]->ratio;
    const MedianInterval& b = known[known.size() / 2]->ratio;
    const MedianInterval middle = {std::sqrt(a.median * b.median), std::sqrt(a.low * b.low),
                                   std::sqrt(a.high * b.high), known.size()};
    tail = fmt::format("{}, {} .. {}", ratio_text(middle), ratio_text(known.front()->ratio.median),
                       ratio_text(known.back()->ratio.median));
  }
  std::vector<std::string> ours;
  for (const Duel* duel : duels) {
    if (!duel->ours.empty()) ours.push_back(short_label(duel->ours));
  }
  tail += "  " + (duels.size() == 1 ? duels[0]->names() : most_often(ours));
  std::vector<std::string> leaders;
  for (const Duel* duel : duels) {
    if (duel->side == Side::slower) leaders.push_back(short_label(duel->library));
  }
  if (duels.size() > 1 && !leaders.empty()) tail += "; behind " + most_often(leaders);
  return line_of(name, duels, tail);
}

// A scene that was asked everything: where libraries lead, then each question weighted by its pairs.
std::string scene_lines(const std::string& scene, const Duels& duels) {
  std::vector<std::string> led;
  for (const Duel* duel : known_of(duels)) {
    if (duel->side != Side::slower) continue;
    led.push_back(fmt::format(
        "{} {} ({})", duel->key->narrow() ? duel->key->task + " " + duel->key->pair_kind : "boxes",
        ratio_text(duel->ratio.median), short_label(duel->library)));
  }
  std::string text = line_of(
      scene, duels,
      led.empty() ? "" : fmt::format("LIBRARIES LEAD IN {} OF {}", led.size(), duels.size()));
  if (!led.empty()) text += "  libraries lead  " + list_text(led, 3) + "\n";
  std::vector<std::string> questions, parts;
  for (const Duel* duel : duels) {
    if (std::ranges::find(questions, duel->question()) != questions.end()) continue;
    questions.push_back(duel->question());
    Duels own;
    double known = 0, all = 0;
    for (const Duel* other : duels) {
      if (other->question() != duel->question()) continue;
      own.push_back(other);
      all += other->queries;
      if (!std::isnan(other->ratio.median)) known += other->queries;
    }
    const std::string name(duel->key->narrow() ? duel->key->task : "boxes");
    if (known == 0) {
      const bool none =
          std::ranges::all_of(own, [](const Duel* each) { return each->side == Side::no_library; });
      const bool asked = std::ranges::any_of(own, &Duel::asks_libraries);
      parts.push_back(name + (!none   ? " not decided"
                              : asked ? " no library is right"
                                      : " no library was asked"));
      continue;
    }
    parts.push_back(fmt::format("{} {}", name, ratio_text(by_pairs(own))));
    if (known < all) {
      const double percent = 100 * known / all;
      parts.back() += fmt::format(" on {} % of the {}",
                                  percent < 1 ? "under 1" : fmt::format("{:.0f}", percent),
                                  duel->key->narrow() ? "pairs" : "inputs");
    }
  }
  return text + "  by pairs        " + list_text(parts) + "\n";
}

std::string fast_text(const std::vector<Duel>& duels) {
  std::vector<std::string> scenes, whole, questions;
  for (const Duel& duel : duels) {
    if (std::ranges::find(scenes, duel.key->scene) == scenes.end())
      scenes.push_back(duel.key->scene);
  }
  for (const std::string& scene : scenes) {
    const auto has = [&](bool narrow) {
      return std::ranges::any_of(duels, [&](const Duel& duel) {
        return duel.key->scene == scene && duel.key->narrow() == narrow;
      });
    };
    if (has(true) && has(false) && whole.size() < most_scenes) whole.push_back(scene);
  }
  std::string text = fmt::format(
      "HOW FAST  time of the fastest library that is right over that of the fastest of ours that "
      "is right; above 1 ours is faster\n{:<28}{:>7}{:>9}{:>8}{:>9}{:>18}   {}\n",
      "", "inputs", "faster", "slower", "unclear", "no library right",
      "median (interval), least .. greatest");
  const auto some = [&](const auto& wanted) {
    Duels found;
    for (const Duel& duel : duels) {
      if (wanted(duel)) found.push_back(&duel);
    }
    return found;
  };
  for (const std::string& scene : whole) {
    text += scene_lines(scene, some([&](const Duel& duel) { return duel.key->scene == scene; }));
  }
  const auto is_other = [&](const Duel& duel) {
    return std::ranges::find(whole, duel.key->scene) == whole.end();
  };
  for (const Duel& duel : duels) {
    const std::string question = duel.question();
    if (!is_other(duel) || std::ranges::find(questions, question) != questions.end()) continue;
    questions.push_back(question);
    text += question_line(question, some([&](const Duel& other) {
                            return is_other(other) && other.question() == question;
                          }));
  }
  return text;
}

// Ratios of an algorithm to the fastest other of ours, or library.
struct Rivals {
  std::string_view what;
  std::vector<std::string> names;
  std::vector<double> ratios;

  std::string text() const {
    if (ratios.empty()) return "";
    if (ratios.size() == 1) {
      return fmt::format("{} x the time of {} ({})", ratio_text(ratios[0]), names[0], what);
    }
    return fmt::format("{} x the time of the {} ({} .. {}; {})", ratio_text(median(ratios)), what,
                       ratio_text(std::ranges::min(ratios)), ratio_text(std::ranges::max(ratios)),
                       most_often(names));
  }
};

std::string own_text(const Results& results, const Tables& tables, const ReportSetting& setting) {
  std::string text;
  if (setting.own.size() > most_scenes) return text;  // a selection, rather than one's own
  for (const std::string& name : setting.own) {
    Rivals ours = {"fastest other of ours", {}, {}}, library = {"fastest library", {}, {}};
    std::size_t inputs = 0, wrong = 0, undecided = 0;
    std::vector<double> seconds;
    for (const SampleSet& set : results.sets) {
      for (const Contestant& mine : set.contestants) {
        if (mine.label != name && !mine.label.starts_with(name + " ")) continue;
        ++inputs;
        wrong += !is_right(set, mine, tables.depth_error);
        const auto squares = by_square(mine, setting.noise);
        for (const auto& [square, value] : squares) seconds.push_back(value);
        for (Rivals* rivals : {&ours, &library}) {
          const Contestant* const rival = fastest(set, setting.noise, [&](const Contestant& other) {
            return &other != &mine && other.batch == mine.batch && !other.is_limit() &&
                   (rivals == &ours ? other.is_ours() : other.is_others()) &&
                   is_right(set, other, tables.depth_error);
          });
          if (rival == nullptr) continue;
          const double ratio = if_known(ratio_between(set, mine, *rival, setting.noise)).median;
          if (std::isnan(ratio)) {
            ++undecided;
          } else {
            rivals->ratios.push_back(ratio);
            rivals->names.push_back(short_label(rival->label));
          }
        }
      }
    }
    if (inputs == 0) continue;
    std::vector<std::string> words;
    for (const Rivals* rivals : {&ours, &library}) {
      if (!rivals->ratios.empty()) words.push_back(rivals->text());
    }
    if (undecided > 0)
      words.push_back(
          fmt::format("{} not decided (fewer than six undisturbed squares)", undecided));
    if (words.empty()) {
      words.push_back(seconds.empty()
                          ? "not timed"
                          : seconds_text(median(seconds)) + "; nothing right stands beside it");
    }
    if (wrong > 0) words.push_back(fmt::format("NOT RIGHT in {}", wrong));
    text += fmt::format("YOURS     {}, {} input{}: {}\n", name, inputs, inputs == 1 ? "" : "s",
                        fmt::join(words, "; "));
  }
  return text;
}

}  // namespace

FastText how_fast(const Results& results, const Tables& tables, const ReportSetting& setting) {
  FastText found;
  const std::vector<Duel> duels = duels_of(results, tables, found.doubts);
  if (!duels.empty()) found.text = fast_text(duels) + own_text(results, tables, setting) + "\n";
  return found;
}

std::string doubts_text(const Doubts& doubts) {
  std::vector<std::string> words;
  if (!doubts.suspect.empty()) {
    words.push_back(fmt::format("{} (an algorithm differed from its own copy): {}",
                                doubts.suspect.size(), list_text(doubts.suspect, 1)));
  }
  if (doubts.few_squares > 0) {
    words.push_back(fmt::format("{} (fewer than six undisturbed squares)", doubts.few_squares));
  }
  if (doubts.none_of_ours > 0) {
    words.push_back(fmt::format("{} (none of ours is right)", doubts.none_of_ours));
  }
  return words.empty() ? ""
                       : fmt::format("NOT TRUSTED of {}, counted as unclear: {}\n", doubts.inputs,
                                     fmt::join(words, "; "));
}

}  // namespace touchstone::stats

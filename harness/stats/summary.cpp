// Formats the summary of a run.
#include "harness/stats/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <ranges>
#include <utility>

#include "harness/base/names.h"
#include "harness/files/text_file.h"
#include "harness/stats/table_check.h"
#include "harness/stats/tables/table_parts.h"

namespace touchstone::stats {
namespace {

constexpr std::size_t most_scenes = 4;  // with rows of their own; algorithms of the user too
constexpr std::size_t most_named = 4;   // in a line

// --- words -----------------------------------------------------------------------------------------

std::string ratio_text(double ratio) {
  if (ratio >= 9.95) return fmt::format("{:.0f}", ratio);
  return ratio >= 0.0995 ? fmt::format("{:.2f}", ratio) : fmt::format("{:.2g}", ratio);
}

std::string ratio_text(const MedianInterval& ratio) {
  return fmt::format("{} ({} to {})", ratio_text(ratio.median), ratio_text(ratio.low),
                     ratio_text(ratio.high));
}

// Returns the number with a comma for each thousand.
std::string count_text(std::int64_t count) {
  std::string text = std::to_string(count);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

std::string metres_text(double metres) {
  constexpr std::array<std::pair<double, const char*>, 3> units = {
      {{1, "m"}, {1e-3, "mm"}, {1e-6, "um"}}};
  for (const auto& [unit, name] : units) {
    if (metres < 0.995 * unit) continue;
    return metres >= 9.95 * unit ? fmt::format("{:.0f} {}", metres / unit, name)
                                 : fmt::format("{:.2g} {}", metres / unit, name);
  }
  return fmt::format("{:.0e} m", metres);
}

std::string seconds_text(double seconds) {
  if (seconds >= 1e-3) return fmt::format("{:.3g} ms", seconds * 1e3);
  return seconds >= 1e-6 ? fmt::format("{:.3g} us", seconds * 1e6)
                         : fmt::format("{:.3g} ns", seconds * 1e9);
}

// Most are asked in double, which goes without saying.
std::string short_label(std::string label) {
  const std::size_t at = label.find(" double");
  return at == std::string::npos ? label : label.erase(at, std::string_view(" double").size());
}

// Joins the first words, and counts the others.
std::string list_text(const std::vector<std::string>& words, std::size_t most = most_named) {
  const auto shown = std::span(words).first(std::min(most, words.size()));
  std::string text = fmt::format("{}", fmt::join(shown, ", "));
  if (words.size() > shown.size()) text += fmt::format(", {} more", words.size() - shown.size());
  return text;
}

// Joins the first words, and counts the others, in lines of the page's width that are indented.
std::string lines_text(const std::vector<std::string>& words, std::size_t indent) {
  constexpr std::size_t width = 120;
  std::string text;
  std::size_t column = indent;
  const auto add = [&](const std::string& word) {
    if (!text.empty()) {
      text += ";";
      const bool fits = column + word.size() + 2 <= width;
      text += fits ? " " : "\n" + std::string(indent, ' ');
      column = fits ? column + 2 : indent;
    }
    text += word;
    column += word.size();
  };
  const std::size_t shown = std::min(most_named, words.size());
  for (const std::string& word : std::span(words).first(shown)) add(word);
  if (words.size() > shown) add(fmt::format("{} more", words.size() - shown));
  return text;
}

// Returns the two most frequent names.
std::string most_often(const std::vector<std::string>& names) {
  std::map<std::string, std::ptrdiff_t> counts;
  for (const std::string& name : names) ++counts[name];
  std::vector<std::string> all;
  for (const auto& [name, count] : counts) all.push_back(name);
  std::ranges::stable_sort(all, std::greater<>(), [&](const auto& name) { return counts[name]; });
  all.resize(std::min<std::size_t>(all.size(), 2));
  return fmt::format("{}", fmt::join(all, ", "));
}

std::string_view question_of(std::string_view task) {
  if (task.empty()) return "Which boxes overlap";
  if (task == "intersect") return "Do two bodies touch";
  if (task == "distance") return "How far apart";
  if (task == "penetration") return "How deep";
  return task == "signed" ? "How far, or how deep" : "Where do they touch";
}

// --- how fast --------------------------------------------------------------------------------------

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

// What is not to be trusted.
struct Doubts {
  std::size_t inputs = 0, few_squares = 0, none_of_ours = 0;
  std::vector<std::string> suspect;
};

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
  if (!led.empty()) text += "  libraries lead  " + list_text(led) + "\n";
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

// --- the user's own --------------------------------------------------------------------------------

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
                   other.is_ours() == (rivals == &ours) && is_right(set, other, tables.depth_error);
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

// --- how right -------------------------------------------------------------------------------------

// What is wrong with one algorithm.
struct Fault {
  std::string label;
  bool ours = false, by_design = false;
  bool slow = false;  // took more than the campaign's limit for a frame
  std::int64_t wrong = 0, queries = 0, unanswered = 0;
  double metres = nan;  // the worst answer on the wrong side
  double error = nan;   // the worst number beyond the stated error
  bool is_bound = false;
  std::vector<std::string> scenes;
  std::string what;      // the first departure, shortened
  std::size_t more = 0;  // the number of further departures

  // Returns what is wrong with the answers; empty if nothing is.
  std::string wrong_text() const {
    std::vector<std::string> words;
    if (wrong > 0) {
      words.push_back(fmt::format("{} of {}", count_text(wrong), count_text(queries)));
      std::vector<std::string> more_words;
      if (!std::isnan(metres)) more_words.push_back("by up to " + metres_text(metres));
      more_words.push_back(list_text(scenes, 2));
      words.back() += fmt::format(" ({})", fmt::join(more_words, "; "));
    }
    if (!std::isnan(error)) {
      words.push_back(is_bound ? fmt::format("depths up to {:.2g} of the size too large", error)
                               : fmt::format("a number off by up to {:.2g} of the size", error));
    }
    if (words.empty() && !what.empty())
      words.push_back(what + (more > 0 ? fmt::format(", and {} more", more) : ""));
    if (words.empty()) return "";
    return fmt::format("{} {}", short_label(label), fmt::join(words, ", "));
  }
};

std::vector<Fault> faults_of(const Tables& tables, std::span<const record::Departure> departures) {
  std::vector<Fault> faults;
  const auto fault_of = [&](const std::string& label, bool ours) -> Fault& {
    const auto at = std::ranges::find(faults, label, &Fault::label);
    if (at != faults.end()) return *at;
    Fault& fault = faults.emplace_back();
    fault.label = label;
    fault.ours = ours;
    return fault;
  };
  for (const AgreementRow& row : tables.agreement) {
    Fault& fault = fault_of(row.label, row.origin == record::RowOrigin::ours);
    fault.queries += row.queries;
    fault.wrong += row.wrong;
    fault.unanswered += row.failed + row.unanswered;
    fault.metres = std::fmax(fault.metres, row.worst_disagreement);
    const std::string scene = row.key.scene.substr(
        0, std::min(row.key.scene.find(" gap "), row.key.scene.find(" depth ")));
    if (row.wrong > 0 && std::ranges::find(fault.scenes, scene) == fault.scenes.end())
      fault.scenes.push_back(scene);
    if (!(row.worst_error > tables.depth_error)) continue;
    fault.error = std::fmax(fault.error, row.worst_error);
    fault.is_bound = row.depth_is_bound;
  }
  for (const record::Departure& departure : departures) {
    Fault& fault = fault_of(departure.algorithm, departure.ours);
    fault.by_design =
        fault.by_design || departure.what.find("approximate by design") != std::string::npos;
    if (departure.what.find("limit of") != std::string::npos ||
        departure.what.find("not answered within") != std::string::npos) {
      fault.slow = true;
    } else if (fault.what.empty()) {
      fault.what = departure.what.substr(0, departure.what.find(';')) + " on " +
                   departure.where.substr(0, departure.where.find(','));
    } else {
      ++fault.more;
    }
  }
  std::ranges::stable_sort(faults, std::greater<>(), &Fault::wrong);
  return faults;
}

std::string right_text(const Results& results, const Tables& tables,
                       std::span<const record::Departure> departures, bool stopped) {
  std::int64_t queries = 0, frames = 0;
  bool libraries = false;
  for (const SampleSet& set : results.sets) {
    for (const Contestant& contestant : set.contestants) {
      libraries = libraries || contestant.origin == record::RowOrigin::peer;
      if (!set.key.narrow()) frames += static_cast<std::int64_t>(contestant.checks.size());
    }
  }
  for (const AgreementRow& row : tables.agreement) queries += row.queries;
  if (queries == 0 && frames == 0 && departures.empty()) return "";

  std::vector<std::string> of_libraries, of_ours, by_design, unanswered, slow;
  for (const Fault& fault : faults_of(tables, departures)) {
    const std::string text = fault.wrong_text();
    if (fault.slow) slow.push_back(short_label(fault.label));
    if (!text.empty()) {
      (fault.by_design || (fault.is_bound && fault.wrong == 0) ? by_design
       : fault.ours                                            ? of_ours
                                                               : of_libraries)
          .push_back(text);
    }
    if (fault.ours && fault.unanswered > 0) {
      unanswered.push_back(fmt::format("{} {} of {}", short_label(fault.label),
                                       count_text(fault.unanswered), count_text(fault.queries)));
    }
  }
  std::string text = fmt::format(
      "HOW RIGHT answers on the wrong side of contact, of those asked; numbers off by more than "
      "{:g} of the pair's size{}\n",
      tables.depth_error, stopped ? "; of what was checked before the stop" : "");
  const auto add = [&](std::string_view who, const std::vector<std::string>& words) {
    text += fmt::format("  {:<12}{}\n", who, words.empty() ? "none" : lines_text(words, 14));
  };
  if (libraries) add("libraries", of_libraries);
  add("ours", of_ours);
  if (!by_design.empty()) add("by design", by_design);
  if (!unanswered.empty()) add("unanswered", unanswered);
  if (!slow.empty()) add("over time", slow);
  return text;
}

// --- the rest --------------------------------------------------------------------------------------

std::string doubts_text(const Doubts& doubts) {
  std::vector<std::string> words;
  if (!doubts.suspect.empty()) {
    words.push_back(fmt::format("{} of {} (an algorithm differed from its own copy): {}",
                                doubts.suspect.size(), doubts.inputs,
                                list_text(doubts.suspect, 3)));
  }
  if (doubts.few_squares > 0) {
    words.push_back(fmt::format(
        "{} of {} have fewer than six undisturbed squares: no ratio, counted as unclear",
        doubts.few_squares, doubts.inputs));
  }
  if (doubts.none_of_ours > 0) {
    words.push_back(fmt::format("in {} of {} none of ours is right, counted as unclear",
                                doubts.none_of_ours, doubts.inputs));
  }
  return words.empty() ? "" : fmt::format("NOT TRUSTED  {}\n", fmt::join(words, "\n             "));
}

struct Disturbed {
  std::int64_t samples = 0, noisy = 0;
};

Disturbed disturbed(const Results& results) {
  Disturbed found;
  for (const SampleSet& set : results.sets) {
    for (const Contestant& contestant : set.contestants) {
      found.samples += std::ssize(contestant.samples);
      found.noisy += std::ranges::count(contestant.samples, true, &Sample::noisy);
    }
  }
  return found;
}

std::string head_text(const Results& results, const Disturbed& disturbed, Noise noise) {
  std::vector<std::string> facts;
  const auto add = [&](const char* name, const char* behind) {
    const auto at = results.machine.find(name);
    if (at != results.machine.end()) facts.push_back(at->second + behind);
  };
  add("processor", "");
  add("cores_online", " cores");
  for (const std::string& isa : results.isa) facts.push_back(isa);
  const std::string samples =
      disturbed.samples == 0 ? "Nothing was timed."
      : disturbed.noisy == 0
          ? fmt::format("None of {} samples was disturbed.", count_text(disturbed.samples))
          : fmt::format(
                "{:.{}f} % of {} samples were disturbed and {}.",
                100 * static_cast<double>(disturbed.noisy) / static_cast<double>(disturbed.samples),
                100 * disturbed.noisy < 10 * disturbed.samples ? 1 : 0,
                count_text(disturbed.samples), noise == Noise::kept ? "counted" : "left out");
  return fmt::format("Touchstone, {}: {}. {}\n",
                     results.campaign.empty() ? "a run" : results.campaign, fmt::join(facts, ", "),
                     samples);
}

std::string files_text(const std::filesystem::path& folder) {
  const std::string word = base::shell_word(folder.string());
  std::string text = fmt::format(
      "Tables    {}\nAgain     touchstone show {}\nPage      touchstone report {} --out "
      "page.html\n",
      (folder / "tables.md").string(), word, word);
  std::error_code error;
  const std::filesystem::path cases = folder / "reproductions";
  const auto count = std::filesystem::is_directory(cases, error)
                         ? std::ranges::distance(std::filesystem::directory_iterator(cases, error))
                         : 0;
  if (count > 0)
    text += fmt::format("Wrong     {} ({} case{})\n", cases.string(), count, count == 1 ? "" : "s");
  return text;
}

}  // namespace

std::string summary(const Results& results, const Tables& tables,
                    std::span<const record::Departure> departures,
                    const std::filesystem::path& folder, const ReportSetting& setting) {
  const Disturbed share = disturbed(results);
  std::string text = head_text(results, share, setting.noise);
  if (setting.stopped) {
    text += fmt::format("Stopped in {}. Go on: {}\n", setting.stopped->at, setting.stopped->go_on);
  }
  text += "\n";
  Doubts doubts;
  const std::vector<Duel> duels = duels_of(results, tables, doubts);
  const bool too_noisy = setting.noise == Noise::left_out && 2 * share.noisy > share.samples;
  if (too_noisy) {
    text += fmt::format(
        "TOO NOISY TO COMPARE  other programs disturbed {:.0f} % of the samples. Answers were "
        "checked: see below.\nRun again when the machine is quiet, or count disturbed samples too: "
        "touchstone show {} --tables --noisy\n\n",
        100 * static_cast<double>(share.noisy) / static_cast<double>(share.samples),
        base::shell_word(folder.string()));
  } else if (!duels.empty()) {
    text += fast_text(duels) + own_text(results, tables, setting) + "\n";
  }
  if (const std::string right =
          right_text(results, tables, departures, setting.stopped.has_value());
      !right.empty()) {
    text += right;
    if (!too_noisy) text += doubts_text(doubts);
    text += "\n";
  }
  return text + files_text(folder);
}

RunReport write_report(const Results& results, std::span<const record::Departure> departures,
                       const Published* published, const ReportSetting& setting,
                       const std::filesystem::path& folder) {
  const Tables tables = make_tables(results, setting.noise, setting.depth_error);
  RunReport report;
  report.tables = tables_markdown(tables);
  files::write_text(folder / "tables.md", report.tables);
  if (published != nullptr && !published->source.empty()) {
    const auto rows = check_published(*published, results, setting.noise);
    write_published(*published, rows, folder);
    report.published = published_text(*published, rows);
  }
  report.summary = summary(results, tables, departures, folder, setting);
  return report;
}

}  // namespace touchstone::stats

// touchstone query: asks algorithms the questions of a file, of any kind, and writes or prints their answers.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/base/names.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/report.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/files/output_file.h"
#include "harness/kinds/kind.h"
#include "harness/kinds/questions.h"
#include "harness/kinds/selection.h"
#include "harness/modules/modules.h"
#include "harness/process/isolate.h"
#include "harness/report/case_view.h"

namespace touchstone::commands {
namespace {

using kinds::QueryOption;
using kinds::Questions;
using kinds::ShownAnswer;
using Value = QueryOption::Value;

// More questions than this are summed up where they are not written.
constexpr std::size_t most_shown = 10;

// --- answers in lines ---

// One digit and the exponent, such as 3e-8.
std::string roughly(double x) {
  std::string text = fmt::format("{:.1g}", x);
  const std::size_t zero = text.find('e');
  if (zero != std::string::npos && text[zero + 2] == '0') text.erase(zero + 2, 1);
  return text;
}

// A number that is off by so much: its digits down to there, and one more.
std::string digits_of(double number, double off) {
  const std::string shortest = fmt::format("{}", number);
  if (!(off > 0) || !std::isfinite(off)) return shortest;
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(off))) + 1, 0, 30);
  std::string text = fmt::format("{:.{}f}", number, decimals);
  return text.size() < shortest.size() ? text : shortest;
}

bool has_bounds(const ShownAnswer& shown) {
  return std::isfinite(shown.lower) && std::isfinite(shown.upper);
}
double bound_of(const ShownAnswer& shown) {
  return std::max(shown.number - shown.lower, shown.upper - shown.number);
}

// "-0.2185 +- 1e-14 m (proven)": a number with its bounds; "-0.43 m (at least -0.43)" where it has one of them.
std::string number_with_bounds(const ShownAnswer& shown, std::string_view unit, bool is_oracle) {
  if (std::isnan(shown.number)) {
    return has_bounds(shown) ? fmt::format("from {} to {} {}", shown.lower, shown.upper, unit) : "";
  }
  const bool has_both = has_bounds(shown);
  std::string text =
      has_both ? digits_of(shown.number, bound_of(shown)) + " +- " + roughly(bound_of(shown))
               : fmt::format("{}", shown.number);
  if (!unit.empty()) text += fmt::format(" {}", unit);
  if (has_both) {
    text += is_oracle ? " (proven)" : " (certified)";
  } else if (std::isfinite(shown.lower)) {
    text += fmt::format(" (at least {:.6g})", shown.lower);
  } else if (std::isfinite(shown.upper)) {
    text += fmt::format(" (at most {:.6g})", shown.upper);
  }
  return text;
}

// "-0.218532327 (off by 3e-8)": a number beside the exact one, whose verdict it shares.
std::string number_beside(const ShownAnswer& shown, const ShownAnswer& exact) {
  const double off = std::abs(shown.number - exact.number);
  const double known = has_bounds(exact) ? bound_of(exact) : 0;
  if (off <= known) return digits_of(shown.number, known) + " (exact)";
  return fmt::format("{} (off by {})", digits_of(shown.number, off), roughly(off));
}

std::string line_text(const Questions& questions, std::size_t question, std::size_t contestant,
                      const std::optional<ShownAnswer>& exact) {
  const ShownAnswer shown = questions.shown(question, contestant);
  const bool is_oracle = questions.info(contestant).origin == Origin::oracle;
  std::vector<std::string> parts;
  const auto add = [&](std::string part) {
    if (!part.empty()) parts.push_back(std::move(part));
  };
  const bool is_compared = exact && !is_oracle && shown.verdict == exact->verdict &&
                           std::isfinite(shown.number) && std::isfinite(exact->number);
  if (is_compared) {
    add(number_beside(shown, *exact));
  } else {
    add(std::string(shown.verdict));
    add(number_with_bounds(shown, questions.unit(), is_oracle));
  }
  add(shown.more);
  if (exact && !is_oracle && shown.verdict != exact->verdict) {
    add(fmt::format("[exact: {}]", exact->verdict));
  }
  const bool is_meant = shown.status == Status::ok || shown.status == Status::not_reported;
  if (!is_meant) add(fmt::format("[{}]", to_string(shown.status)));
  return fmt::format("{}", fmt::join(parts, "  "));
}

// Such as "ok 5, not_reported 2 (the library has no status)".
std::string status_counts(const std::map<Status, std::size_t>& statuses) {
  std::string text;
  for (const auto& [status, count] : statuses) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", to_string(status), count);
    if (status == Status::not_reported) text += " (the library has no status)";
  }
  return text;
}

// Prints to standard error the first of the questions that an algorithm lost, and the number of the others.
void print_lost(std::string_view algorithm, std::span<const kinds::AskFailure> failures) {
  constexpr std::size_t most = 5;
  for (const kinds::AskFailure& failure : failures.first(std::min(most, failures.size()))) {
    fmt::print(stderr, "{}, {}: {}\n", algorithm, failure.label, failure.reason);
  }
  if (failures.size() > most) {
    fmt::print(stderr, "{}: {} more failures\n", algorithm, failures.size() - most);
  }
}

// For each question a line for each algorithm, the exact one first: its answer, its number, the bound that is proven,
// and how far it is off the exact one. Those that do not take the question are one line.
void print_lines(const Questions& questions) {
  std::vector<std::size_t> order(questions.contestants());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto is_oracle = [&](std::size_t c) { return questions.info(c).origin == Origin::oracle; };
  std::ranges::stable_partition(order, is_oracle);
  for (std::size_t i = 0; i < questions.size(); ++i) {
    fmt::print("{}\n", questions.label(i));
    std::optional<ShownAnswer> exact;
    if (!order.empty() && is_oracle(order[0])) exact = questions.shown(i, order[0]);
    if (exact && exact->status != Status::ok) exact.reset();
    std::vector<std::string> without;
    for (const std::size_t c : order) {
      if (questions.shown(i, c).status == Status::unsupported) {
        without.push_back(questions.name(c));
        continue;
      }
      fmt::print("  {:<28} {}\n", questions.name(c), line_text(questions, i, c, exact));
    }
    if (!without.empty()) fmt::print("  not taken by {}\n", fmt::join(without, ", "));
  }
}

// The place of the oracle among the contestants, if it is asked.
std::optional<std::size_t> oracle_of(const Questions& questions) {
  for (std::size_t c = 0; c < questions.contestants(); ++c) {
    if (questions.info(c).origin == Origin::oracle) return c;
  }
  return std::nullopt;
}

// Where an answer that counts has another verdict than the exact one: how often, and where first.
std::string other_verdicts(const Questions& questions, std::size_t contestant, std::size_t oracle) {
  std::size_t count = 0, first = 0;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    const ShownAnswer shown = questions.shown(i, contestant), exact = questions.shown(i, oracle);
    const bool are_answers = exact.status == Status::ok &&
                             (shown.status == Status::ok || shown.status == Status::not_reported);
    if (!are_answers || shown.verdict == exact.verdict) continue;
    if (count++ == 0) first = i;
  }
  if (count == 0) return "";
  return fmt::format("; {} other than exact, the first in {}", count, questions.label(first));
}

// The number of each answer and each status of every algorithm.
void print_counts(const Questions& questions) {
  const std::optional<std::size_t> oracle = oracle_of(questions);
  const std::vector<std::string_view> verdicts = questions.verdicts();
  std::string line = fmt::format("{:<28}", "algorithm");
  for (const std::string_view verdict : verdicts) line += fmt::format(" {:>11}", verdict);
  fmt::print("{}  status\n", line);
  for (std::size_t c = 0; c < questions.contestants(); ++c) {
    std::vector<std::size_t> counts(verdicts.size());
    std::map<Status, std::size_t> statuses;
    for (std::size_t i = 0; i < questions.size(); ++i) {
      const ShownAnswer shown = questions.shown(i, c);
      ++statuses[shown.status];
      const auto at = std::ranges::find(verdicts, shown.verdict);
      if (at != verdicts.end()) ++counts[static_cast<std::size_t>(at - verdicts.begin())];
    }
    line = fmt::format("{:<28}", questions.name(c));
    for (const std::size_t count : counts) line += fmt::format(" {:>11}", count);
    fmt::print("{}  {}{}\n", line, status_counts(statuses),
               oracle ? other_verdicts(questions, c, *oracle) : "");
  }
}

// How to ask those that were left out because they calculate in the other of float and double alone.
void print_scalar_hint(const Questions& questions, Precision asked) {
  const std::vector<std::string> names = questions.of_other_scalar();
  if (names.empty()) return;
  const bool is_double = asked == Precision::float64;
  fmt::print("Without an answer, as they calculate in {} alone: {}; --scalar {} asks them\n",
             is_double ? "float" : "double", fmt::join(names, ", "),
             is_double ? "float" : "double");
}

// --- the command line ---

struct QueryOptions {
  std::string file, names = "all", task, kind, out, certificates;
  std::vector<std::string> peers;
  std::int64_t repeat = 0;
  std::optional<double> time_limit;
  // The options of kinds by name, and whether the command line has them.
  std::map<std::string, std::string> texts;
  std::map<std::string, std::vector<std::string>> lists;
  std::map<std::string, bool> flags;
  std::vector<std::pair<std::string, Option>> of_kinds;
};

// Returns what is wrong with the text of an option, or an empty string.
std::string option_fault(const QueryOption& option, const std::string& text) {
  if (option.value <= Value::list) return "";  // no number, and no choice
  if (option.value == Value::choice) {
    std::string names;
    for (const std::string_view name : option.choices) {
      if (name == text) return "";
      names += fmt::format("{}{}", names.empty() ? "" : " or ", name);
    }
    return fmt::format("{}: found '{}'; expected {}", option.name, text, names);
  }
  const bool is_integer = option.value == Value::count || option.value == Value::natural;
  const bool may_be_zero = option.value == Value::not_negative || option.value == Value::natural;
  std::size_t end = 0;
  double value = -1;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  const bool is_right =
      end == text.size() && !text.empty() && std::isfinite(value) &&
      (may_be_zero ? value >= 0 : value > 0) &&
      (!is_integer || (value == std::floor(value) && value <= std::numeric_limits<int>::max()));
  if (is_right) return "";
  return fmt::format("{}: found '{}'; expected {} {} 0", option.name, text,
                     is_integer ? "an integer" : "a finite number", may_be_zero ? ">=" : ">");
}

std::string kinds_with(std::string_view name) {
  std::string list;
  for (const kinds::Kind* kind : kinds::asked_kinds()) {
    for (const QueryOption& option : kind->query_options()) {
      if (option.name == name) list += fmt::format("{}{}", list.empty() ? "" : ", ", kind->name());
    }
  }
  return list;
}

// Throws InputError for an option that the kind does not have, and for a wrong value.
void check_options(const kinds::Kind& kind, const kinds::QuestionInput& input) {
  const std::vector<QueryOption> own = kind.query_options();
  for (const auto& [name, text] : input.options) {
    const auto at = std::ranges::find(own, name, &QueryOption::name);
    if (at == own.end()) {
      throw base::InputError(
          fmt::format("{} was given; expected it with questions of the kind {}, and not {}", name,
                      kinds_with(name), kind.name()));
    }
    const std::string fault = option_fault(*at, text);
    if (!fault.empty()) throw base::InputError(fault);
    if (!at->excludes.empty() && input.has(at->excludes)) {
      throw base::InputError(
          fmt::format("{} excludes {}; expected one of them", name, at->excludes));
    }
  }
}

kinds::QuestionInput input_of(const QueryOptions& options) {
  modules::load_named(options.names);
  kinds::QuestionInput input = {.file = options.file,
                                .names = kinds::split_names(joined_names(
                                    options.names, start_peers(options.peers, options.repeat))),
                                .task = options.task,
                                .time_limit = options.time_limit};
  for (const auto& [name, option] : options.of_kinds) {
    if (!option.given()) continue;
    const auto text = options.texts.find(name);
    input.options[name] = text == options.texts.end() ? "" : text->second;
    const auto list = options.lists.find(name);
    if (list == options.lists.end()) continue;
    std::vector<std::string> words = list->second;
    // A list takes all words behind it, FILE too.
    if (input.file.empty() && words.size() > 1) {
      input.file = words.back();
      words.pop_back();
    }
    input.options[name] = fmt::format("{}", fmt::join(words, ","));
  }
  return input;
}

// Proves each answer in a child process, which has so many seconds for it.
void save_proofs(const std::string& file, const kinds::Proving& proving, double seconds) {
  files::OutputFile output(file);
  for (const std::string& line : proving.head) {
    if (line.size() >= base::longest_text) {
      throw base::InputError(
          file, 0,
          fmt::format("cannot hold what is asked, in a line of {} bytes; expected at most {}",
                      line.size(), base::longest_text));
    }
    output.write(line + "\n");
  }
  const process::IsolationLimits limits = {
      .item_seconds = seconds, .setup_seconds = std::numeric_limits<double>::infinity()};
  const process::LinesReport report = process::isolated_lines(
      proving.items, limits, proving.setup, [&](const std::string& line) { output.write(line); });
  if (!report.failures.empty() && report.failures.back().in_setup) {
    throw base::InputError(file, 0, "no more can be proven: " + report.failures.back().reason());
  }
  std::vector<kinds::AskFailure> lost;
  for (const process::IsolationFailure& failure : report.failures)
    lost.push_back({proving.label(failure.item), failure.reason()});
  print_lost("certificates", lost);
  output.close();
  fmt::print("{} certificates in {}\n", report.lines, file);
}

// Asks every algorithm about all questions, part by part, and writes the answers in the order of the questions.
void ask_all(kinds::Questions& questions, files::CsvWriter* csv) {
  do {
    for (std::size_t c = 0; c < questions.contestants(); ++c) {
      print_lost(questions.info(c).name, questions.ask(c));
    }
    if (csv == nullptr && questions.size() <= most_shown) print_lines(questions);
    for (std::size_t i = 0; csv != nullptr && i < questions.size(); ++i) {
      for (std::size_t c = 0; c < questions.contestants(); ++c) questions.write(*csv, i, c);
    }
  } while (questions.next());
}

// The command that asks about a pair again.
std::string command_of(const kinds::QuestionInput& input, const files::ConcaveCase& c) {
  std::string command = "./touchstone query " + base::shell_word(input.file.string());
  if (!input.has("--bodies")) return command + " --id " + base::shell_word(c.id);
  command += " --bodies " + input.text("--bodies");
  if (input.has("--frame")) command += " --frame " + input.text("--frame");
  return command;
}

// Makes the page of the pairs.
void draw_pairs(const Questions& questions, const kinds::QuestionInput& input,
                const std::string& page) {
  const std::string name = input.file.filename().string();
  std::vector<report::AskedPair> pairs;
  for (const files::ConcaveCase& c : questions.pairs()) {
    pairs.push_back({.c = c, .source = name, .command = command_of(input, c)});
  }
  files::OrderedJson results = files::OrderedJson::array();
  results.push_back({{"name", name},
                     {"folder", input.file.parent_path().string()},
                     {"files", files::OrderedJson::object()},
                     {"cases", report::pair_views(pairs, input.seconds())},
                     {"notes", files::OrderedJson::array()}});
  write_report(input.text("--page"), page, std::move(results), files::OrderedJson::array());
}

int query(const QueryOptions& options) {
  const kinds::QuestionInput input = input_of(options);
  if (input.file.empty() && !input.has("--settled")) {
    throw base::InputError("FILE is missing; expected it, or --certificates alone");
  }
  const kinds::Kind& kind = kinds::told_kind(input, options.kind);
  check_options(kind, input);
  const std::unique_ptr<kinds::Questions> questions = kind.read(input);
  const std::string saved = input.text("--save-certificates");
  std::vector<files::NamedFile> outputs = {{"--out", options.out}};
  for (const files::NamedFile& further : questions->outputs()) outputs.push_back(further);
  outputs.push_back({"--save-certificates", saved});
  files::check_outputs(questions->inputs(), outputs);
  const bool is_drawn = input.has("--page") && !questions->pairs().empty();
  // It throws before anything is asked.
  const std::string page = is_drawn ? built_page(input.text("--built-page")) : "";

  std::optional<files::CsvWriter> csv;
  if (!options.out.empty()) csv.emplace(options.out, questions->columns());
  ask_all(*questions, csv ? &*csv : nullptr);
  if (csv) csv->flush();  // reveals a full disk before any file is there
  questions->write_further();
  if (csv) csv->close();
  const bool are_shown = !csv && questions->size() <= most_shown;
  if (!questions->print_summary(are_shown) && !are_shown) {
    print_counts(*questions);
    if (!csv) fmt::print("Every answer: --out FILE.csv\n");
  }
  print_scalar_hint(*questions, input.scalar());
  fmt::print("{}", repeats_text());
  if (is_drawn) draw_pairs(*questions, input, page);
  if (!saved.empty()) save_proofs(saved, questions->proving(), input.seconds());
  return questions->is_wrong() ? exit_measured_wrong : exit_done;
}

int verify(const QueryOptions& options) {
  const kinds::Kind& kind = kinds::told_kind_of_proofs(options.certificates, options.kind);
  return kind.verify(options.certificates, options.file) ? exit_done : exit_measured_wrong;
}

// Adds each option once, with the kinds that have it.
void add_options_of_kinds(Arguments& command, QueryOptions& options) {
  std::vector<std::string> names;
  std::map<std::string, std::string> helps;
  std::map<std::string, Value> values;
  for (const kinds::Kind* kind : kinds::asked_kinds()) {
    for (const QueryOption& option : kind->query_options()) {
      const std::string name(option.name), help(option.help);
      std::string& text = helps[name];
      if (text.empty()) names.push_back(name);
      if (text.find(help) == std::string::npos) text += (text.empty() ? "" : ". Or: ") + help;
      values[name] = option.value;
    }
  }
  for (const std::string& name : names) {
    const std::string help = fmt::format("{} [{}]", helps[name], kinds_with(name));
    const auto add = [&] {
      if (values[name] == Value::flag) return command.flag(name, options.flags[name], help);
      if (values[name] == Value::file) {
        return command.text(name, options.texts[name], help).is_read();
      }
      if (values[name] != Value::list) return command.text(name, options.texts[name], help);
      return command.texts(name, options.lists[name], help).separated_by_commas();
    };
    options.of_kinds.emplace_back(name, add());
  }
}

}  // namespace

void add_query(Arguments command) {
  const auto options = std::make_shared<QueryOptions>();
  std::string kind_list;
  for (const kinds::Kind* kind : kinds::asked_kinds()) {
    kind_list += fmt::format("{}{}", kind_list.empty() ? "" : ", ", kind->name());
  }
  command
      .text("FILE", options->file,
            "The questions. JSON, one object a line: pairs of bodies, which may move. CSV: boxes, "
            "rays, points, or moving vertices and edges; or a folder of the last, or a recording "
            "of boxes (.aabbs); or with --bodies a scene")
      .is_read();
  command
      .text("--with,--narrow,--broad,--cast,--ccd,--query,--algorithm", options->names,
            "Algorithms: names joined by commas, all, ours, libraries, oracle, or the file of a "
            "module, "
            "such as ./libmine.so")
      .show_default();
  const Option peer = add_peer(command, options->peers);
  command
      .number("--repeat", options->repeat,
              "Also have each peer repeat a question so often, and show the times that it reports "
              "itself")
      .within(1, 1'000'000'000)
      .needs(peer);
  command.text("--task", options->task, "What is asked (default: the kind's fullest)");
  command.text("--kind", options->kind,
               "The kind of the questions, where the file does not tell: " + kind_list);
  command.text("--out", options->out, "The CSV file of answers (default: they are printed)");
  command
      .number("--time-limit", options->time_limit,
              "Seconds that an answer may take, and its proof (default: 5; of 512 features 60; of "
              "boxes none)")
      .positive();
  add_options_of_kinds(command, *options);
  command
      .text(
          "--certificates", options->certificates,
          "Only verify the proofs in this file, and with FILE that each is of one of its questions")
      .is_read();
  command.exclude_others("--certificates", {"FILE", "--kind"});
  command.job([options]() -> int {
    return options->certificates.empty() ? query(*options) : verify(*options);
  });
}

}  // namespace touchstone::commands

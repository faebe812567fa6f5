// touchstone query: asks algorithms the questions of a file, of any kind, and writes or prints their answers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/commands/arguments.h"
#include "harness/commands/commands.h"
#include "harness/commands/query/answer_lines.h"
#include "harness/commands/shared_options.h"
#include "harness/files/csv.h"
#include "harness/files/output_file.h"
#include "harness/kinds/kind.h"
#include "harness/kinds/questions.h"
#include "harness/kinds/selection.h"
#include "harness/process/isolated_lines.h"

namespace touchstone::commands {
namespace {

using kinds::QueryOption;
using Value = QueryOption::Value;

// More questions than this are summed up where they are not written.
constexpr std::size_t most_shown = 10;

struct QueryOptions {
  std::string file, names = "all", task, kind, out, certificates;
  std::optional<double> time_limit;
  // The options of kinds by name, and whether the command line has them.
  std::map<std::string, std::string> texts;
  std::map<std::string, bool> flags;
  std::vector<std::pair<std::string, Option>> of_kinds;
};

// Returns what is wrong with the text of an option, or an empty string.
std::string option_fault(const QueryOption& option, const std::string& text) {
  if (option.value == Value::flag || option.value == Value::text) return "";
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
  kinds::QuestionInput input = {.file = options.file,
                                .names = kinds::split_names(options.names),
                                .task = options.task,
                                .time_limit = options.time_limit};
  for (const auto& [name, option] : options.of_kinds) {
    if (!option.given()) continue;
    const auto text = options.texts.find(name);
    input.options[name] = text == options.texts.end() ? "" : text->second;
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
  print_failures("certificates", report.failures, proving.label);
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

int query(const QueryOptions& options) {
  const kinds::QuestionInput input = input_of(options);
  if (options.file.empty() && !input.has("--settled")) {
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

  std::optional<files::CsvWriter> csv;
  if (!options.out.empty()) csv.emplace(options.out, questions->columns());
  ask_all(*questions, csv ? &*csv : nullptr);
  if (csv) csv->flush();  // reveals a full disk before any file is there
  questions->write_further();
  if (csv) csv->close();
  const bool are_shown = !csv && questions->size() <= most_shown;
  if (!questions->print_summary(are_shown) && !are_shown) print_counts(*questions);
  print_scalar_hint(*questions, input.scalar());
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
  std::map<std::string, bool> is_flag;
  for (const kinds::Kind* kind : kinds::asked_kinds()) {
    for (const QueryOption& option : kind->query_options()) {
      const std::string name(option.name), help(option.help);
      std::string& text = helps[name];
      if (text.empty()) names.push_back(name);
      if (text.find(help) == std::string::npos) text += (text.empty() ? "" : ". Or: ") + help;
      is_flag[name] = option.value == Value::flag;
    }
  }
  for (const std::string& name : names) {
    const std::string help = fmt::format("{} [{}]", helps[name], kinds_with(name));
    const Option option = is_flag[name] ? command.flag(name, options.flags[name], help)
                                        : command.text(name, options.texts[name], help);
    options.of_kinds.emplace_back(name, option);
  }
}

}  // namespace

void add_query(Arguments command) {
  const auto options = std::make_shared<QueryOptions>();
  std::string kind_list;
  for (const kinds::Kind* kind : kinds::asked_kinds()) {
    kind_list += fmt::format("{}{}", kind_list.empty() ? "" : ", ", kind->name());
  }
  command.text(
      "FILE", options->file,
      "The questions. JSON, one object a line: pairs of bodies, which may move. CSV: boxes, rays, "
      "points, or "
      "moving vertices and edges; or a folder of the last, or a recording of boxes (.aabbs)");
  command
      .text("--with,--narrow,--broad,--cast,--ccd,--query,--algorithm", options->names,
            "Algorithms: names joined by commas, all, ours, libraries or oracle")
      .show_default();
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
  command.text(
      "--certificates", options->certificates,
      "Only verify the proofs in this file, and with FILE that each is of one of its questions");
  command.exclude_others("--certificates", {"FILE", "--kind"});
  command.job([options]() -> int {
    return options->certificates.empty() ? query(*options) : verify(*options);
  });
}

}  // namespace touchstone::commands

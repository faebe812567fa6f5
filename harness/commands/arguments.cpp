// Command lines with CLI11: options, checks, help.
#include "harness/commands/arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>

#include "harness/base/data_folder.h"
#include "harness/base/names.h"
#include "harness/commands/commands.h"

namespace touchstone::commands {
namespace {

using Words = CLI::results_t;

template <class T>
constexpr const char* type_name = std::is_floating_point_v<T> ? "FLOAT"
                                  : std::is_signed_v<T>       ? "INT"
                                                              : "UINT";
template <class T>
constexpr const char* type_name<std::optional<T>> = type_name<T>;

template <class T>
bool read(const std::string& word, T& value) {
  return CLI::detail::lexical_cast(word, value);
}
template <class T>
bool read(const std::string& word, std::optional<T>& value) {
  return read(word, value.emplace());
}

// Formats a value as a stream does: six digits of a double.
template <class T>
std::string shown(const T& value) {
  if constexpr (std::is_floating_point_v<T>) {
    return fmt::format("{:g}", value);
  } else {
    return fmt::format("{}", value);
  }
}
template <class T>
std::string shown(const std::optional<T>& value) {
  return value ? shown(*value) : "";
}

CLI::Option* add_option(CLI::App& app, const std::string& name, const std::string& help,
                        const char* type, bool many, CLI::callback_t take,
                        std::function<std::string()> present = {}) {
  CLI::Option* const option =
      app.add_option(name, std::move(take), help, false, std::move(present));
  option->type_name(type)->type_size(1, 1);
  option->expected(1, many ? CLI::detail::expected_max_vector_size : 1);
  option->allow_extra_args(many);
  return option;
}

std::string join(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ","));
}

// Adds a check that shows `what` behind the option's type in --help.
Option add_check(CLI::Option* option, const std::string& what,
                 std::function<std::string(const std::string&)> fault) {
  option->check(
      CLI::Validator([fault = std::move(fault)](std::string& text) { return fault(text); }, what));
  return Option(option);
}

template <class T>
Option add_range(CLI::Option* option, const std::string& what, T low, T high) {
  return add_check(option, what, [low, high](const std::string& text) {
    T value{};
    if (read(text, value) && value >= low && value <= high) return std::string();
    return fmt::format("Value {} not in range {} to {}", text, low, high);
  });
}

}  // namespace

// --- options ---

Option Option::required() {
  option_->required();
  return *this;
}

Option Option::excludes(Option other) {
  option_->excludes(other.option_);
  return *this;
}

Option Option::needs(Option other) {
  option_->needs(other.option_);
  return *this;
}

Option Option::group(const std::string& heading) {
  option_->group(heading);
  return *this;
}

Option Option::separated_by_commas() {
  option_->delimiter(',');
  return *this;
}

Option Option::value_optional() {
  option_->expected(0, 1);
  return *this;
}

Option Option::once_each() {
  option_->allow_extra_args(false);
  return *this;
}

Option Option::is_read() {
  option_->transform([](const std::string& name) { return base::found(name).string(); }, "");
  return *this;
}

Option Option::show_default() {
  option_->capture_default_str();
  return *this;
}

Option Option::show_default(const std::string& text) {
  option_->default_str(text);
  return *this;
}

Option Option::among(std::vector<std::string> names) {
  const std::string set = "{" + join(names) + "}";
  return add_check(option_, set, [names = std::move(names), set](const std::string& text) {
    return std::ranges::find(names, text) != names.end() ? "" : text + " not in " + set;
  });
}

Option Option::within(std::int64_t low, std::int64_t high) {
  return add_range(option_, fmt::format("in [{} - {}]", low, high), low, high);
}

Option Option::within_real(double low, double high) {
  return add_range(option_, fmt::format("in [{:g} - {:g}]", low, high), low, high);
}

Option Option::positive() {
  return add_check(option_, "POSITIVE", [](const std::string& text) {
    double value = 0;
    const bool good = read(text, value) && value > 0 && std::isfinite(value);
    return good ? "" : fmt::format("found '{}'; expected a finite number > 0", text);
  });
}

Option Option::not_negative() {
  return add_check(option_, "NONNEGATIVE", [](const std::string& text) {
    double value = 0;
    const bool good = read(text, value) && value >= 0 && std::isfinite(value);
    return good ? "" : fmt::format("found '{}'; expected a finite number >= 0", text);
  });
}

Option Option::check(std::function<std::string(const std::string&)> fault) {
  return add_check(option_, "", std::move(fault));
}

bool Option::given() const { return option_->count() > 0; }

std::string Option::name() const { return option_->get_name(); }

// --- commands ---

Option Arguments::text(const std::string& name, std::string& value, const std::string& help) {
  const auto take = [&value](const Words& words) {
    value = words.front();
    return true;
  };
  return Option(add_option(*app_, name, help, "TEXT", false, take, [&value] { return value; }));
}

Option Arguments::texts(const std::string& name, std::vector<std::string>& values,
                        const std::string& help) {
  const auto take = [&values](const Words& words) {
    values = words;
    return true;
  };
  return Option(add_option(*app_, name, help, "TEXT", true, take,
                           [&values] { return "[" + join(values) + "]"; }));
}

Option Arguments::flag(const std::string& name, bool& value, const std::string& help) {
  return Option(app_->add_flag(name, value, help));
}

template <class T>
Option Arguments::number(const std::string& name, T& value, const std::string& help) {
  const auto take = [&value](const Words& words) { return read(words.front(), value); };
  return Option(
      add_option(*app_, name, help, type_name<T>, false, take, [&value] { return shown(value); }));
}
template Option Arguments::number(const std::string&, int&, const std::string&);
template Option Arguments::number(const std::string&, std::int64_t&, const std::string&);
template Option Arguments::number(const std::string&, std::uint64_t&, const std::string&);
template Option Arguments::number(const std::string&, double&, const std::string&);
template Option Arguments::number(const std::string&, std::optional<int>&, const std::string&);
template Option Arguments::number(const std::string&, std::optional<std::uint64_t>&,
                                  const std::string&);
template Option Arguments::number(const std::string&, std::optional<double>&, const std::string&);

template <class T>
Option Arguments::numbers(const std::string& name, std::vector<T>& values,
                          const std::string& help) {
  const auto take = [&values](const Words& words) {
    values.clear();
    return std::ranges::all_of(
        words, [&](const std::string& word) { return read(word, values.emplace_back()); });
  };
  CLI::Option* const option = add_option(*app_, name, help, type_name<T>, true, take, [&values] {
    return fmt::format("[{}]", fmt::join(values, ","));
  });
  return Option(option).separated_by_commas();
}
template Option Arguments::numbers(const std::string&, std::vector<int>&, const std::string&);
template Option Arguments::numbers(const std::string&, std::vector<std::int64_t>&,
                                   const std::string&);

Option Arguments::choice(const std::string& name, const std::vector<std::string>& names,
                         const std::string& help, bool many,
                         std::function<void(const std::vector<std::size_t>&)> take) {
  const auto take_words = [names, take = std::move(take)](const Words& words) {
    std::vector<std::size_t> chosen;
    for (const std::string& word : words) {
      chosen.push_back(static_cast<std::size_t>(std::ranges::find(names, word) - names.begin()));
    }
    take(chosen);
    return true;
  };
  CLI::Option* const option = add_option(*app_, name, help, "TEXT", many, take_words);
  if (many) option->delimiter(',');
  return Option(option).among(names);
}

Option Arguments::option(const std::string& name) const { return Option(app_->get_option(name)); }

void Arguments::exclude_others(const std::string& name, const std::vector<std::string>& except) {
  CLI::Option* const one = app_->get_option(name);
  std::set<CLI::Option*> allowed = {one, app_->get_help_ptr()};
  for (const std::string& other : except) allowed.insert(app_->get_option(other));
  for (CLI::Option* other : app_->get_options()) {
    if (!allowed.contains(other)) one->excludes(other);
  }
}

void Arguments::footer(const std::string& text) { app_->footer(text); }

std::string Arguments::shell_line(std::string_view left_out) const {
  std::string line = app_->get_name();
  for (const CLI::App* app = app_->get_parent(); app != nullptr; app = app->get_parent()) {
    line = app->get_name() + " " + line;
  }
  for (const CLI::Option* option : app_->get_options()) {
    if (option->count() == 0 || option->get_name() == left_out) continue;
    if (!option->get_positional()) line += " " + option->get_name();
    const std::string value = join(option->results());
    const bool is_bare = value.empty() && option->get_expected_min() == 0;
    if (option->get_expected_max() > 0 && !is_bare) line += " " + base::shell_word(value);
  }
  return line;
}

Arguments Arguments::nested(const std::string& name, const std::string& about) {
  app_->require_subcommand(1);
  return {app_->add_subcommand(name, about)->group("Commands"), status_};
}

void Arguments::job(std::function<int()> work) {
  app_->callback([work = std::move(work), status = status_] { *status = work(); });
}

void Arguments::before_commands(std::function<void()> work) {
  app_->parse_complete_callback(std::move(work));
}

// --- the program ---

CommandLine::CommandLine(const std::string& about)
    : app_(std::make_unique<CLI::App>(about, "touchstone")) {
  app_->require_subcommand(1);
  app_->fallthrough();
}

CommandLine::~CommandLine() = default;

void CommandLine::version(const std::string& text) {
  app_->set_version_flag("--version", text, "Print the version and exit");
}

Arguments CommandLine::everywhere() { return {app_.get(), &status_}; }

Arguments CommandLine::add_command(const std::string& name, const std::string& about,
                                   const std::string& heading) {
  return {app_->add_subcommand(name, about)->group(heading), &status_};
}

int CommandLine::run(const std::vector<std::string>& words) {
  try {
    app_->parse(std::vector<std::string>(words.rbegin(), words.rend()));
    return status_;
  } catch (const CLI::ParseError& error) {
    const bool help = error.get_exit_code() == 0;
    // The command that the words lead to.
    const CLI::App* at = app_.get();
    while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
    if (help) return app_->exit(error) == 0 ? exit_done : exit_bad_request;
    if (at->get_subcommands({}).empty()) {
      std::fprintf(stderr, "touchstone: %s\nRun with --help for more information.\n", error.what());
      return exit_bad_request;
    }
    std::fprintf(stderr, "touchstone: %s\nExpected a command, one of:", error.what());
    for (const CLI::App* command : at->get_subcommands({})) {
      std::fprintf(stderr, " %s", command->get_name().c_str());
    }
    std::fputs(". Run with --help for more information.\n", stderr);
    return exit_bad_request;
  }
}

}  // namespace touchstone::commands

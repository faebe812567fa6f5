// The command line: commands, their options, and the checks of their values.
// Only arguments.cpp includes the library that parses it, whose templates take longer to compile
// than all commands together.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace touchstone::commands {

// An option, or an argument without a name. Each rule returns the option, so that rules can be
// chained.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option required();
  Option excludes(Option other);
  Option needs(Option other);
  Option group(const std::string& heading);  // the heading in --help
  Option separated_by_commas();
  Option value_optional();  // the option may stand without a value
  Option once_each();       // each value stands behind a name of its own
  // Each value names a file or folder that is read: what is not there is taken from the data folder (base::found).
  Option is_read();

  // Shows the present value, or this text, in --help.
  Option show_default();
  Option show_default(const std::string& text);

  Option among(std::vector<std::string> names);
  Option within(std::int64_t low, std::int64_t high);
  Option within_real(double low, double high);
  Option positive();
  Option not_negative();
  // `fault` describes the error in a value, with an empty text if there is none.
  Option check(std::function<std::string(const std::string&)> fault);

  // Returns true if the command line has it.
  bool given() const;
  std::string name() const;  // such as "--out"

 private:
  CLI::Option* option_;
};

// The options of a command. A value that is not given stays unchanged. References must live until
// the command has run.
class Arguments {
 public:
  Arguments(CLI::App* app, int* status) : app_(app), status_(status) {}

  // Names of options begin with "--"; names of positional arguments do not.
  Option text(const std::string& name, std::string& value, const std::string& help);
  Option texts(const std::string& name, std::vector<std::string>& values, const std::string& help);
  Option flag(const std::string& name, bool& value, const std::string& help);

  // T is int, std::int64_t, std::uint64_t, double, or std::optional of one of these.
  template <class T>
  Option number(const std::string& name, T& value, const std::string& help);
  // T is int or std::int64_t. Values are separated by commas or blanks.
  template <class T>
  Option numbers(const std::string& name, std::vector<T>& values, const std::string& help);

  template <class E>
  using Choices = std::vector<std::pair<std::string, E>>;  // names and their values
  // Adds a choice of one value. `value` is an E, or std::optional<E>.
  template <class E, class Value>
  Option one_of(const std::string& name, Value& value, const Choices<E>& choices,
                const std::string& help) {
    return choice(name, names_of(choices), help, false, [choices, &value](const auto& chosen) {
      value = choices[chosen.front()].second;
    });
  }
  // Adds a choice of several values, separated by commas or blanks.
  template <class E>
  Option some_of(const std::string& name, std::vector<E>& values, const Choices<E>& choices,
                 const std::string& help) {
    return choice(name, names_of(choices), help, true, [choices, &values](const auto& chosen) {
      values.clear();
      for (const std::size_t i : chosen) values.push_back(choices[i].second);
    });
  }

  // Returns the option of this name, which was added before.
  Option option(const std::string& name) const;
  // Excludes every other option that the command has until now, except --help and these.
  void exclude_others(const std::string& name, const std::vector<std::string>& except = {});
  // Sets the text below the options in --help.
  void footer(const std::string& text);

  // Returns a shell line that gives this command the same options, except those that are left out.
  std::string shell_line(std::string_view left_out) const;

  // Adds a command within this one, which is then nothing without one of them.
  Arguments nested(const std::string& name, const std::string& about);

  // Sets the work that follows after all options are read; it returns the program's exit status.
  void job(std::function<int()> work);
  // Sets work that runs before every command.
  void before_commands(std::function<void()> work);

 private:
  template <class E>
  static std::vector<std::string> names_of(const Choices<E>& choices) {
    std::vector<std::string> names;
    for (const auto& choice : choices) names.push_back(choice.first);
    return names;
  }
  Option choice(const std::string& name, const std::vector<std::string>& names,
                const std::string& help, bool many,
                std::function<void(const std::vector<std::size_t>&)> take);

  CLI::App* app_;
  int* status_;
};

// The program's command line: one command, one job.
class CommandLine {
 public:
  explicit CommandLine(const std::string& about);
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  // Adds --version, which prints this text.
  void version(const std::string& text);
  // Returns the options that may stand anywhere.
  Arguments everywhere();
  // `heading` is that under which --help lists the command.
  Arguments add_command(const std::string& name, const std::string& about,
                        const std::string& heading = "Commands");

  // Runs the command of these words, which do not include the program's name. Prints --help, or the
  // error in the words and what was expected. Returns the exit status; exceptions of the command's
  // job pass through.
  int run(const std::vector<std::string>& words);

 private:
  std::unique_ptr<CLI::App> app_;
  int status_ = 0;
};

}  // namespace touchstone::commands

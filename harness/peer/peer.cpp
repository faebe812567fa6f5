// Reads the first line of a peer, and adds it to the registry.
#include "harness/peer/peer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <system_error>
#include <type_traits>
#include <utility>

#include "algorithms/registry.h"
#include "harness/base/error.h"
#include "harness/base/group_words.h"
#include "harness/base/input_file.h"
#include "harness/files/output_file.h"
#include "harness/peer/adapters.h"
#include "harness/peer/offers.h"
#include "harness/peer/peer_process.h"
#include "harness/process/child_process.h"
#include "harness/record/build_info.h"

namespace touchstone::peer {
namespace {

constexpr double start_seconds = 60;

// A program, which each process starts for itself when it first asks.
class ProgramLink final : public Link {
 public:
  ProgramLink(Program program, std::shared_ptr<Use> use)
      : program_(std::move(program)), use_(std::move(use)) {}

  std::vector<std::string> answers(std::string_view before,
                                   std::span<const Question> questions) override {
    std::string text(before);
    for (const Question& question : questions) text += line_of(question);
    return asked([&](PeerProcess& process) {
      std::vector<std::string> lines = process.exchange(text, questions.size());
      if (use_->repeat() > 0) std::ranges::for_each(lines, [&](auto& line) { keep_time(line); });
      return lines;
    });
  }

  bool takes_packed() const override { return true; }
  std::pair<std::string, std::string> packed_answer(
      const Question& question, std::string_view bytes,
      const std::function<std::size_t(const std::string&)>& size_of) override {
    std::string text = question.line;
    text += bytes;
    return asked([&](PeerProcess& process) {
      std::string line = process.exchange(text, 1).front();
      std::string packed = process.bytes(size_of(line));
      return std::pair(std::move(line), std::move(packed));
    });
  }

 private:
  template <class Ask>
  std::invoke_result_t<const Ask&, PeerProcess&> asked(const Ask& ask) {
    const bool is_new = owner_ != getpid();
    if (is_new) {
      static_cast<void>(process_.release());  // it is the parent's
      process_ = std::make_unique<PeerProcess>(program_, ProgramLimits{.use = use_.get()});
      owner_ = getpid();
    }
    try {
      if (is_new) process_->exchange(greeting(), 1);
      return ask(*process_);
    } catch (...) {
      owner_ = -1;  // the next question gets a new program
      process_.reset();
      throw;
    }
  }

  // How often it is to be repeated is no part of a question, so its id is the same.
  std::string line_of(const Question& question) const {
    if (use_->repeat() == 0) return question.line;
    std::string line = question.line;
    return line.insert(line.find(',') + 1, fmt::format("\"repeat\":{},", use_->repeat()));
  }

  void keep_time(const std::string& line) const {
    const files::Json answer = files::Json::parse(line, nullptr, false);
    if (!answer.is_object()) return;  // who asks says what is wrong
    static const std::string name = "answer";
    try {
      const double seconds = known_number(files::JsonNode(name, 0, answer), "seconds");
      if (std::isnan(seconds)) return;
      if (!(seconds >= 0 && std::isfinite(seconds))) {
        throw process::Garbage(fmt::format("seconds: found {}; expected a time", seconds));
      }
      use_->add_seconds(seconds / static_cast<double>(use_->repeat()));
    } catch (const base::InputError& error) {
      throw process::Garbage(error.what());
    }
  }

  Program program_;
  std::shared_ptr<Use> use_;
  std::unique_ptr<PeerProcess> process_;
  pid_t owner_ = -1;
};

// Without an answer.
std::string unsupported(const Question& question) {
  return fmt::format(R"({{"id":"{}","status":"unsupported"}})", question.id);
}

// What a program answered elsewhere.
class AnswersLink final : public Link {
 public:
  explicit AnswersLink(std::map<std::string, std::string, std::less<>> by_id)
      : by_id_(std::move(by_id)) {}

  std::vector<std::string> answers(std::string_view /*before*/,
                                   std::span<const Question> questions) override {
    std::vector<std::string> lines;
    for (const Question& question : questions) {
      const auto at = by_id_.find(question.id);
      lines.push_back(at == by_id_.end() ? unsupported(question) : at->second);
    }
    return lines;
  }

 private:
  std::map<std::string, std::string, std::less<>> by_id_;
};

[[noreturn]] void throw_error(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

// A file that is gone when it is closed. Processes that share it append whole parts.
class QuestionWriter::Kept final : public Link {
 public:
  Kept() {
    if (file_ == nullptr || fcntl(descriptor(), F_SETFL, O_APPEND) != 0) {
      throw_error("temporary file");
    }
    keep(greeting());
  }

  std::vector<std::string> answers(std::string_view before,
                                   std::span<const Question> questions) override {
    std::string text(before);
    std::vector<std::string> lines;
    for (const Question& question : questions) {
      text += question.line;
      lines.push_back(unsupported(question));
    }
    keep(text);
    return lines;
  }

  std::int64_t copy_to(files::OutputFile& output) const {
    std::int64_t lines = 0;
    std::string text(1 << 16, '\0');
    for (off_t at = 0;;) {
      const ssize_t got = pread(descriptor(), text.data(), text.size(), at);
      if (got < 0) throw_error("temporary file");
      if (got == 0) return lines;
      at += got;
      const std::string_view part(text.data(), static_cast<std::size_t>(got));
      lines += std::ranges::count(part, '\n');
      output.write(std::string(part));
    }
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  int descriptor() const { return fileno(file_.get()); }

  void keep(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = write(descriptor(), text.data(), text.size());
      if (written < 0) throw_error("temporary file");
      text.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  std::unique_ptr<std::FILE, Close> file_{std::tmpfile()};
};

namespace {

// --- the first line ---

using Add = void (*)(const AlgorithmInfo&, const files::JsonNode&, const std::shared_ptr<Link>&);
constexpr auto kinds = std::to_array<std::pair<std::string_view, Add>>({{"pair", add_pair},
                                                                        {"cast", add_cast},
                                                                        {"ray", add_ray},
                                                                        {"point", add_point},
                                                                        {"mesh", add_mesh},
                                                                        {"feature", add_feature},
                                                                        {"box", add_box}});

std::string names_of_kinds() {
  std::string names;
  for (const auto& [name, add] : kinds)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
  return names;
}

constexpr std::string_view of_versions =
    "0123456789.+_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ-";
constexpr std::string_view of_names = "0123456789abcdefghijklmnopqrstuvwxyz-";

std::string word(const files::JsonNode& hello, const char* key, std::string_view letters,
                 std::string_view expected) {
  const files::JsonNode node = hello.at(key, expected);
  const std::string& text = node.text(expected);
  if (text.empty() || text.size() > 60 || text.find_first_not_of(letters) != std::string::npos) {
    node.fail(fmt::format("found '{}'; expected {}", base::shortened(text), expected));
  }
  return text;
}

// NAME, or NAME@VERSION if it has one.
std::string name_of(const files::JsonNode& hello) {
  std::string name = word(hello, "name", of_names, "a name of small letters, digits and '-'");
  if (hello.has("version")) {
    name +=
        '@' + word(hello, "version", of_versions, "a version of letters, digits, '.', '+', '-'");
  }
  return name;
}

void expect_new(const files::JsonNode& hello, const std::string& name) {
  if (base::is_group_word(name)) {
    hello.fail(
        fmt::format("found the name '{}', which means several algorithms; expected another", name));
  }
  registry::for_each_kind([&]<class Entry>() {
    if (registry::find<Entry>(name) == nullptr) return;
    hello.fail(
        fmt::format("an algorithm is called '{}' already; expected another name or version", name));
  });
}

// `source` is called so in messages: the command, or the file with its line.
std::string add_entries(const std::string& source, std::int64_t line, const files::Json& value,
                        const std::shared_ptr<Link>& link) {
  const files::JsonNode hello(source, line, value);
  hello.as_object(R"(a peer's first line, such as {"protocol":1,"name":...,"kinds":...})");
  const files::JsonNode protocol = hello.at("protocol", "the number of the protocol");
  if (protocol.number() != protocol_version) {
    protocol.fail(fmt::format("found {}; expected {}", protocol.found(), protocol_version));
  }
  AlgorithmInfo info = {.name = name_of(hello), .citation = source, .origin = Origin::peer};
  expect_new(hello, info.name);
  if (hello.has("library")) info.citation = hello.at("library", "").text("the library's name");
  const files::JsonNode offers = hello.at("kinds", "an object with what is offered of each kind");
  offers.as_object("an object with what is offered of each kind");
  if (offers.size() == 0) offers.fail("found no kind; expected at least one");
  for (const auto& [name, offer] : offers.value().items()) {
    const auto* const at = std::ranges::find(kinds, name, &std::pair<std::string_view, Add>::first);
    if (at == kinds.end()) {
      offers.fail(fmt::format("found \"{}\"; expected some of {}", name, names_of_kinds()));
    }
    const files::JsonNode node = offers.at(name.c_str(), "");
    at->second(info, node.as_object("an object, such as {\"tasks\":[...]}"), link);
  }
  return info.name;
}

// All that this program asks.
files::OrderedJson all_offers() {
  const auto names = [](const auto& values) {
    files::OrderedJson list = files::OrderedJson::array();
    for (const auto value : values) list.push_back(to_string(value));
    return list;
  };
  const files::OrderedJson scalars = names(all_scalars), shapes = names(all_shape_kinds);
  return {{"pair", {{"tasks", names(all_tasks)}, {"scalars", scalars}, {"shapes", shapes}}},
          {"cast",
           {{"tasks", {"counts", "approach"}},
            {"scalars", scalars},
            {"shapes", shapes},
            {"rotation", true},
            {"approach", true}}},
          {"ray", {{"tasks", {"closest", "any"}}, {"scalars", scalars}}},
          {"point", {{"tasks", {"closest", "side"}}, {"scalars", {"double"}}}},
          {"mesh", {{"tasks", names(all_concave_tasks)}, {"scalars", scalars}}},
          {"feature", {{"tasks", names(all_feature_pairs)}, {"separations", true}}},
          {"box", {{"tasks", {"pairs"}}}}};
}

files::OrderedJson hello_of_this(std::string_view name) {
  return {{"protocol", protocol_version},
          {"name", name},
          {"version", record::version},
          {"kinds", all_offers()}};
}

// The programs, by the names of their entries.
std::vector<std::pair<std::string, std::shared_ptr<Use>>>& added() {
  static std::vector<std::pair<std::string, std::shared_ptr<Use>>> all;
  return all;
}

}  // namespace

std::string greeting() { return hello_of_this("touchstone").dump() + "\n"; }

std::vector<PeerRow> peer_rows() {
  std::vector<PeerRow> rows;
  for (const auto& [name, use] : added()) rows.push_back(use->row(name));
  return rows;
}

std::string add(const std::string& named, std::int64_t repeat) {
  const Program program = program_of(named);
  const auto use = std::make_shared<Use>(repeat);
  std::string line;
  try {
    PeerProcess process(program, {.use = use.get()});
    line = process.exchange(greeting(), 1, start_seconds).front();
  } catch (const std::exception& error) {
    throw base::InputError(fmt::format("--peer '{}': {}; expected its first line of JSON",
                                       program.command, error.what()));
  }
  const files::Json hello = files::Json::parse(line, nullptr, false);
  if (hello.is_discarded()) {
    throw base::InputError(fmt::format("--peer '{}': found '{}'; expected a first line of JSON",
                                       program.command, base::shortened(line, 200)));
  }
  const std::string name = add_entries(fmt::format("--peer '{}'", program.command), 0, hello,
                                       std::make_shared<ProgramLink>(program, use));
  added().emplace_back(name, use);
  return name;
}

std::string add_answers(const std::filesystem::path& file) {
  std::map<std::string, std::string, std::less<>> by_id;
  files::Json hello;
  std::int64_t first = 0;
  files::for_each_json_line(file, "answer", [&](const files::JsonNode& line) {
    if (hello.is_null()) {
      hello = line.value();
      first = line.line();
      return;
    }
    by_id[line.at("id", "the id of a question").text("the id of a question")] = line.value().dump();
  });
  return add_entries(file.string(), first, hello, std::make_shared<AnswersLink>(std::move(by_id)));
}

QuestionWriter::QuestionWriter()
    : kept_(std::make_shared<Kept>()),
      name_(add_entries("questions", 0, files::Json::parse(hello_of_this("questions").dump()),
                        kept_)) {}

std::int64_t QuestionWriter::save(const std::filesystem::path& file) const {
  files::OutputFile output(file);
  const std::int64_t lines = kept_->copy_to(output);
  output.close();
  return lines - 1;  // the first is the greeting
}

}  // namespace touchstone::peer

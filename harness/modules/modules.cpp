// Loads modules.
#include "harness/modules/modules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <span>
#include <stdexcept>
#include <type_traits>

#include "algorithms/registry.h"
#include "harness/base/clock.h"
#include "harness/base/error.h"
#include "harness/base/group_words.h"
#include "harness/base/hash.h"
#include "harness/base/input_file.h"
#include "harness/modules/file_word.h"
#include "harness/modules/table.h"
#include "harness/process/child_process.h"

namespace touchstone::modules {
namespace {

constexpr double load_seconds = 10;
constexpr int listen_milliseconds = 5;
constexpr std::size_t most_tables = 64;
constexpr std::size_t most_bytes = std::size_t{1} << 30;

std::map<std::filesystem::path, std::string>& loaded() {
  static std::map<std::filesystem::path, std::string> hashes;
  return hashes;
}

// A text of a table. Throws base::InputError if it is null, empty or too long for a line.
std::string text_of(const char* text, const SharedObject& object, std::string_view what) {
  constexpr std::size_t longest = 400;
  const std::string found = text == nullptr ? "" : std::string(text, strnlen(text, longest + 1));
  const bool is_line = std::ranges::none_of(
      found, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; });
  if (found.empty() || found.size() > longest || !is_line) {
    object.fail(fmt::format("{}: found '{}'; expected one line of 1 to {} bytes", what,
                            base::shortened(found), longest));
  }
  return found;
}

template <class Entry>
std::string name_of(const char* text, const SharedObject& object) {
  const std::string what = fmt::format("the name of one of its {}", kind_words<Entry>.title);
  std::string name = text_of(text, object, what);
  static const std::regex form("[a-z0-9]+(-[a-z0-9]+)*");
  if (!std::regex_match(name, form) || name.size() > 60) {
    object.fail(fmt::format("{}: found '{}'; expected at most 60 small letters, digits and '-'",
                            what, base::shortened(name)));
  }
  if (base::is_group_word(name)) {
    object.fail(fmt::format("{}: found '{}', which means several algorithms; expected another",
                            what, name));
  }
  // A module may use a name for several kinds.
  bool is_taken = registry::find<Entry>(name) != nullptr;
  registry::for_each_kind([&]<class Other>() {
    const Other* const other = registry::find<Other>(name);
    is_taken = is_taken || (other != nullptr && other->info.origin == Origin::module &&
                            registry::module_of(other->info) != object.file().string());
  });
  if (is_taken) {
    object.fail(
        fmt::format("{}: an algorithm is called '{}' already; expected another name", what, name));
  }
  return name;
}

template <class Entry, class Table>
void add_all(const Table* const* tables, const std::shared_ptr<const SharedObject>& object,
             TrialAnswers& ahead) {
  for (std::size_t i = 0; tables != nullptr && tables[i] != nullptr; ++i) {
    if (i == most_tables) {
      object->fail(fmt::format("offers more than {} {}; expected NULL behind the last", most_tables,
                               kind_words<Entry>.title));
    }
    constexpr std::size_t least = offsetof(Table, destroy) + sizeof(void*);
    const Table table = copy_of(*tables[i], least, *object, kind_words<Entry>.title);
    std::string name = name_of<Entry>(table.name, *object);
    const AlgorithmInfo info = {.name = name,
                                .citation = text_of(table.citation, *object, name + ", citation"),
                                .origin = Origin::module};
    const auto offer = std::make_shared<const Kept<Table>>(Kept<Table>{object, table, name});
    expect_functions(*offer,
                     {{"create", table.create != nullptr}, {"destroy", table.destroy != nullptr}});
    try {
      add(offer, info, ahead);
    } catch (const std::length_error& error) {
      object->fail(
          fmt::format("{}; expected at most {} of a kind", error.what(), registry::most_added));
    }
  }
}

void add_tables(const std::shared_ptr<const SharedObject>& object, TrialAnswers& ahead) {
  const TouchstoneModule& offer = object->offer();
  add_all<BroadPhaseEntry>(offer.boxes, object, ahead);
  add_all<NarrowPhaseEntry>(offer.pairs, object, ahead);
  add_all<RayCastEntry>(offer.rays, object, ahead);
  add_all<PointQueryEntry>(offer.points, object, ahead);
  add_all<ConcaveEntry>(offer.meshes, object, ahead);
  add_all<CastEntry>(offer.casts, object, ahead);
  add_all<CcdEntry>(offer.features, object, ahead);
}

enum class Trial : std::uint8_t { has_ended, has_threads, has_thrown, has_returned };

// Loads it in a child process, which asks its tables for the answers. The second load, in this process, reports a fault
// that can be described. Throws base::InputError for a file that ends the process, hangs or starts threads.
void try_to_load(const std::filesystem::path& file, std::span<std::uint8_t> answers) {
  process::SharedArray<Trial> trial(1);
  process::ChildProcess child({}, [&] {
    try {
      TrialAnswers ahead(answers, true);
      add_tables(std::make_shared<const SharedObject>(file), ahead);
      trial[0] = Trial::has_threads;
      process::expect_one_thread();
      trial[0] = Trial::has_returned;
    } catch (const base::InputError&) {
      trial[0] = Trial::has_returned;
    } catch (...) {
      if (trial[0] != Trial::has_threads) trial[0] = Trial::has_thrown;
    }
  });
  const base::Stopwatch watch;
  while (!child.has_ended() && watch.seconds() < load_seconds) child.listen(listen_milliseconds);
  if (child.alive()) child.stop();
  if (trial[0] == Trial::has_returned) return;
  throw base::InputError(
      file.string(), 0,
      trial[0] == Trial::has_threads
          ? "starts threads when it is loaded; expected none before an instance is made"
      : trial[0] == Trial::has_thrown
          ? "throws when it is asked what it supports; expected an answer"
          : fmt::format("cannot be loaded: {}; expected a module", child.failure().reason()));
}

}  // namespace

void load(const std::filesystem::path& named) {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(named, error);
  if (error) {
    throw base::InputError(named.string(), 0,
                           fmt::format("{}; expected the file of a module", error.message()));
  }
  if (loaded().contains(file)) return;
  const std::string bytes = base::read_whole(file, most_bytes, "a module");
  process::SharedArray<std::uint8_t> answers(2 * most_tables * most_supports);
  try_to_load(file, answers.span());
  const auto object = std::make_shared<const SharedObject>(file);
  TrialAnswers ahead(answers.span(), false);
  add_tables(object, ahead);
  bool offers_some = false;
  registry::for_each_kind([&]<class Entry>() {
    offers_some =
        offers_some || std::ranges::any_of(registry::entries<Entry>(), [&](const Entry& entry) {
          return registry::module_of(entry.info) == file.string();
        });
  });
  if (!offers_some) object->fail("offers no algorithm; expected at least one");
  base::ByteHash hash;
  hash.add(bytes);
  loaded()[file] = base::to_hex(hash.value());
}

void load_named(std::string_view words) {
  while (!words.empty()) {
    const std::size_t comma = std::min(words.find(','), words.size());
    const std::string_view word = words.substr(0, comma);
    if (is_file(word)) load(word);
    words.remove_prefix(std::min(comma + 1, words.size()));
  }
}

std::vector<std::filesystem::path> files() {
  std::vector<std::filesystem::path> all;
  for (const auto& [file, hash] : loaded()) all.push_back(file);
  return all;
}

std::vector<std::pair<std::string, std::string>> facts() {
  std::vector<std::pair<std::string, std::string>> all;
  for (const auto& [file, hash] : loaded()) {
    all.emplace_back("module " + file.filename().string(), hash);
  }
  return all;
}

}  // namespace touchstone::modules

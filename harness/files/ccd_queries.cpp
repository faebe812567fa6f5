// Reads queries of continuous collision.
#include "harness/files/ccd_queries.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "algorithms/oracle/numbers/ratio.h"
#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/files/packed_files.h"

namespace touchstone::files {
namespace {

using oracle::Integer;

class CcdReader {
 public:
  explicit CcdReader(const std::filesystem::path& file) : file_(file.string()), lines_(file) {}

  CcdQueries read() {
    CcdQueries all;
    CcdQuery query;
    std::size_t row = 0;
    int truth = 0;
    while (const std::optional<std::string_view> line = lines_.next()) {
      ++line_;
      if (line->find_first_not_of(" \t\r\n") == std::string_view::npos) continue;
      split(line_ == 1 ? base::without_byte_order_mark(*line) : *line);
      (row < 4 ? query.start[row] : query.end[row - 4]) = point();
      if (has_truth()) {
        const std::string_view text = fields_.back();
        if (text != "0" && text != "1") {
          fail(fmt::format("found the truth '{}'; expected 0 or 1", base::shortened(text)));
        }
        if (row > 0 && truth != text[0] - '0') {
          fail("found another truth than in the query's first row; expected the same in all eight");
        }
        truth = text[0] - '0';
      }
      if (++row < 8) continue;
      row = 0;
      all.queries.push_back(query);
      if (has_truth()) all.contacts.push_back(static_cast<char>(truth));
    }
    if (row != 0) fail(fmt::format("found {} rows of the last query; expected eight", row));
    if (all.queries.empty()) fail("no query; expected eight rows for each");
    all.rounded = rounded_;
    return all;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw base::InputError(file_, line_, message);
  }

  bool has_truth() const { return fields_.size() == 4 || fields_.size() == 7; }

  void split(std::string_view line) {
    const std::size_t before = fields_.size();
    fields_.clear();
    for (;;) {
      const std::size_t comma = line.find(',');
      std::string_view field = line.substr(0, comma);
      const std::size_t begin = field.find_first_not_of(" \t\r\n");
      field = begin == std::string_view::npos ? "" : field.substr(begin);
      fields_.push_back(field.substr(0, field.find_last_not_of(" \t\r\n") + 1));
      if (comma == std::string_view::npos) break;
      line.remove_prefix(comma + 1);
    }
    const std::size_t count = fields_.size();
    if (count != 3 && count != 4 && count != 6 && count != 7) {
      fail(
          fmt::format("{} columns; expected three coordinates, each a number or a numerator and a "
                      "denominator, and perhaps the truth",
                      count));
    }
    if (before != 0 && count != before) {
      fail(fmt::format("{} columns; expected {}, as in the rows before", count, before));
    }
  }

  Vec3d point() {
    Vec3d x;
    const bool is_rational = fields_.size() >= 6;
    for (std::size_t i = 0; i < 3; ++i) {
      x[static_cast<Eigen::Index>(i)] =
          is_rational ? ratio(fields_[2 * i], fields_[2 * i + 1]) : number(fields_[i]);
    }
    return x;
  }

  double number(std::string_view text) const {
    double value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(value)) {
      fail(fmt::format("found '{}'; expected a number", base::shortened(text)));
    }
    return value;
  }

  Integer integer(std::string_view text) const {
    const std::string_view digits = text.starts_with('-') ? text.substr(1) : text;
    // Leading zeros would make it octal.
    const std::size_t begin = std::min(digits.find_first_not_of('0'), digits.size());
    if (digits.empty() || digits.find_first_not_of("0123456789") != std::string_view::npos) {
      fail(fmt::format("found '{}'; expected an integer", base::shortened(text)));
    }
    if (digits.size() > base::most_digits) {
      fail(fmt::format("an integer of {} digits; expected at most {}", digits.size(),
                       base::most_digits));
    }
    if (begin == digits.size()) return 0;
    const Integer magnitude{std::string(digits.substr(begin))};
    return text.starts_with('-') ? Integer(-magnitude) : magnitude;
  }

  double ratio(std::string_view above, std::string_view below) {
    const Integer numerator = integer(above), denominator = integer(below);
    if (denominator <= 0)
      fail(fmt::format("found the denominator {}; expected one above 0", base::shortened(below)));
    const oracle::NearestDouble nearest = oracle::nearest_double(numerator, denominator);
    if (!std::isfinite(nearest.value)) {
      fail(fmt::format("found {}/{}; expected a number within the range of doubles",
                       base::shortened(above), base::shortened(below)));
    }
    if (!nearest.is_exact) ++rounded_;
    return nearest.value;
  }

  std::string file_;
  LineReader lines_;
  std::int64_t line_ = 0;
  std::vector<std::string_view> fields_;
  std::size_t rounded_ = 0;
};

// A file of the larger public set is SCENE/queries/NAME.csv, and its truths are beside that folder.
std::filesystem::path truths_of(const std::filesystem::path& file) {
  return std::filesystem::absolute(file).lexically_normal().parent_path().parent_path() /
         "mma_bool" / (file.stem().string() + "_mma_bool.json");
}

std::vector<char> read_truths(const std::filesystem::path& file, std::size_t queries) {
  const std::string text = base::read_whole(file, base::longest_text, "the truths of queries");
  const auto list = nlohmann::json::parse(text, nullptr, false);
  const bool is_list = list.is_array() && std::ranges::all_of(list, [](const auto& truth) {
                         return truth.is_boolean();
                       });
  if (!is_list || list.size() != queries) {
    throw base::InputError(
        file.string(), 0,
        fmt::format("{}; expected an array of true or false for each of {} queries",
                    is_list ? fmt::format("{} truths", list.size()) : "no list of truths",
                    queries));
  }
  std::vector<char> contacts;
  contacts.reserve(queries);
  for (const auto& truth : list) contacts.push_back(truth.get<bool>() ? 1 : 0);
  return contacts;
}

// The kind of the features in a file, by its folder, or in the larger set by its name.
std::optional<FeaturePair> kind_of(const std::filesystem::path& file) {
  const std::string folder = file.parent_path().filename().string(), name = file.stem().string();
  const bool is_split = folder == "queries";
  if (folder == "vertex-face" || (is_split && name.ends_with("vf"))) {
    return FeaturePair::vertex_face;
  }
  if (folder == "edge-edge" || (is_split && name.ends_with("ee"))) return FeaturePair::edge_edge;
  return {};
}

}  // namespace

CcdQueries read_ccd_queries(const std::filesystem::path& file) {
  CcdQueries all = CcdReader(file).read();
  const std::filesystem::path truths = truths_of(file);
  std::error_code error;
  if (all.contacts.empty() && std::filesystem::exists(truths, error)) {
    all.contacts = read_truths(truths, all.queries.size());
  }
  return all;
}

std::vector<CcdFile> ccd_files(const std::filesystem::path& folder) {
  std::vector<CcdFile> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, error)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() != ".csv" || !entry.is_regular_file()) continue;
    const std::optional<FeaturePair> pair = kind_of(path);
    if (!pair) continue;
    const std::filesystem::path scene =
        std::filesystem::absolute(path).lexically_normal().parent_path().parent_path();
    files.push_back({path, scene.filename().string(), *pair});
  }
  if (error || files.empty()) {
    throw base::InputError(
        folder.string(), 0,
        "no queries; expected files SCENE/vertex-face/NAME.csv or SCENE/edge-edge/NAME.csv, or "
        "SCENE/queries/NAMEvf.csv or SCENE/queries/NAMEee.csv");
  }
  std::ranges::sort(files, {}, [](const CcdFile& file) {
    return std::tuple(file.file.parent_path().parent_path(), file.pair != FeaturePair::edge_edge,
                      file.file);
  });
  return files;
}

}  // namespace touchstone::files

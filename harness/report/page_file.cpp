// Compresses the bundle and writes the page.
#include "harness/report/page_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <stdexcept>
#include <string_view>

#include "harness/base/error.h"
#include "harness/files/text_file.h"
#include "harness/report/packed_numbers.h"

namespace touchstone::report {
namespace {

// The longest text that Chromium holds is a little longer.
constexpr std::size_t most_characters = 500'000'000;

constexpr std::string_view place_of_bundle = "<!--BUNDLE-->";

std::string compressed(const std::string& text) {
  uLongf size = compressBound(text.size());
  std::string packed(size, '\0');
  const int status =
      compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                reinterpret_cast<const Bytef*>(text.data()), text.size(), Z_BEST_COMPRESSION);
  if (status != Z_OK) throw std::runtime_error("the page's data cannot be compressed");
  packed.resize(size);
  return packed;
}

}  // namespace

std::string base64(std::string_view bytes) {
  namespace iterators = boost::archive::iterators;
  using Letters = iterators::base64_from_binary<iterators::transform_width<const char*, 6, 8>>;
  // It takes whole groups of three bytes; what is added to the last becomes padding.
  std::string whole(bytes);
  const std::size_t added = (3 - bytes.size() % 3) % 3;
  whole.append(added, '\0');
  std::string text(Letters(whole.data()), Letters(whole.data() + whole.size()));
  text.replace(text.size() - added, added, added, '=');
  return text;
}

std::size_t write_page(const std::filesystem::path& out, const std::string& page,
                       const files::OrderedJson& bundle) {
  const std::size_t place = page.find(place_of_bundle);
  if (place == std::string::npos) {
    throw base::InputError("the built page has no place for its data; build it again");
  }
  // Names may have any bytes; those that are not UTF-8 are replaced.
  const std::string text =
      bundle.dump(-1, ' ', false, files::OrderedJson::error_handler_t::replace);
  if (text.size() > most_characters) {
    throw base::InputError(
        fmt::format("{}: its data would be {:.0f} MB, and browsers hold {:.0f}; expected fewer "
                    "--frames, a smaller "
                    "--count or fewer folders",
                    out.string(), static_cast<double>(text.size()) / 1e6,
                    static_cast<double>(most_characters) / 1e6));
  }
  std::string whole = page;
  whole.replace(place, place_of_bundle.size(), base64(compressed(text)));
  files::write_text(out, whole);
  return whole.size();
}

}  // namespace touchstone::report

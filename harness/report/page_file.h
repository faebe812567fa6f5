// The page as a file: the built page with the bundle in it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "harness/files/json_line.h"

namespace touchstone::report {

// Writes `page`, the HTML that plots/page builds, with the bundle in it: JSON, compressed by zlib, in
// base64. So no text of a result can end its element or be taken for a tag. Returns the size in bytes.
// Throws InputError if the page has no place for it or the file cannot be written.
std::size_t write_page(const std::filesystem::path& out, const std::string& page,
                       const files::OrderedJson& bundle);

}  // namespace touchstone::report

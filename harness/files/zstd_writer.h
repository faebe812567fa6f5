// Writes files that are packed by zstd.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "harness/files/output_file.h"

struct ZSTD_CCtx_s;

namespace touchstone::files {

// Packs bytes into one frame, with a checksum, in constant memory. The file is written as an
// OutputFile, with the same errors: it is whole after `close`, and absent without.
class ZstdWriter {
 public:
  // Levels go from 1, the fastest, to 19, the smallest file.
  explicit ZstdWriter(std::filesystem::path file, int level = 3);
  ~ZstdWriter();
  ZstdWriter(const ZstdWriter&) = delete;
  ZstdWriter& operator=(const ZstdWriter&) = delete;

  void write(std::string_view bytes);
  void close();

 private:
  struct FreeContext {
    void operator()(ZSTD_CCtx_s* context) const;
  };
  // Packs the bytes, and ends the frame if they are the last.
  void pack(std::string_view bytes, bool last);

  OutputFile file_;
  std::unique_ptr<ZSTD_CCtx_s, FreeContext> context_;
  std::vector<char> packed_;
};

}  // namespace touchstone::files

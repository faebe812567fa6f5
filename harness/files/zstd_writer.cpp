// Packs files through libzstd.
#include "harness/files/zstd_writer.h"

#include <zstd.h>
#include <zstd_errors.h>

#include <new>
#include <stdexcept>
#include <utility>

namespace touchstone::files {
namespace {

std::size_t checked(std::size_t result) {
  if (ZSTD_isError(result) == 0) return result;
  if (ZSTD_getErrorCode(result) == ZSTD_error_memory_allocation) throw std::bad_alloc();
  throw std::logic_error(ZSTD_getErrorName(result));
}

}  // namespace

void ZstdWriter::FreeContext::operator()(ZSTD_CCtx_s* context) const { ZSTD_freeCCtx(context); }

ZstdWriter::ZstdWriter(std::filesystem::path file, int level)
    : file_(std::move(file)), context_(ZSTD_createCCtx()), packed_(ZSTD_CStreamOutSize()) {
  if (!context_) throw std::bad_alloc();
  checked(ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_compressionLevel, level));
  checked(ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_checksumFlag, 1));
}

ZstdWriter::~ZstdWriter() = default;

void ZstdWriter::write(std::string_view bytes) { pack(bytes, false); }

void ZstdWriter::close() {
  pack({}, true);
  file_.close();
}

void ZstdWriter::pack(std::string_view bytes, bool last) {
  ZSTD_inBuffer input = {bytes.data(), bytes.size(), 0};
  for (bool done = false; !done;) {
    ZSTD_outBuffer output = {packed_.data(), packed_.size(), 0};
    const std::size_t left = checked(
        ZSTD_compressStream2(context_.get(), &output, &input, last ? ZSTD_e_end : ZSTD_e_continue));
    file_.write({packed_.data(), output.pos});
    done = last ? left == 0 : input.pos == input.size;
  }
}

}  // namespace touchstone::files

// Reads plain files, and packed ones through libzstd, and cuts their bytes into lines.
#include "harness/files/packed_files.h"

#include <fmt/format.h>
#include <zstd.h>
#include <zstd_errors.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "harness/base/error.h"
#include "harness/base/input_file.h"

namespace touchstone::files {
namespace {

constexpr const char* packed_ending = ".zst";

}  // namespace

std::filesystem::path packed_name(std::filesystem::path csv) { return csv += packed_ending; }

bool is_packed(const std::filesystem::path& file) { return file.extension() == packed_ending; }

std::filesystem::path row_file(const std::filesystem::path& csv) {
  std::error_code ignored;
  const std::filesystem::path packed = packed_name(csv);
  return !std::filesystem::exists(csv, ignored) && std::filesystem::exists(packed, ignored) ? packed
                                                                                            : csv;
}

struct ByteReader::Unpacking {
  ZSTD_DCtx* context = ZSTD_createDCtx();
  std::vector<char> packed = std::vector<char>(ZSTD_DStreamInSize());
  ZSTD_inBuffer input = {packed.data(), 0, 0};
  bool any = false;       // a byte was read
  bool in_frame = false;  // the frame at hand is not at its end
  bool more = false;      // the context may hold unpacked bytes

  Unpacking() {
    if (context == nullptr) throw std::bad_alloc();
  }
  ~Unpacking() { ZSTD_freeDCtx(context); }
  Unpacking(const Unpacking&) = delete;
  Unpacking& operator=(const Unpacking&) = delete;
};

ByteReader::ByteReader(const std::filesystem::path& file) : file_(file.string()), input_(file) {
  if (is_packed(file)) unpacking_ = std::make_unique<Unpacking>();
}

ByteReader::~ByteReader() = default;

void ByteReader::fail(const std::string& message) const {
  throw base::InputError(file_, 0, message);
}

std::size_t ByteReader::read(std::span<char> buffer) {
  return unpacking_ ? unpack(buffer) : input_.read(buffer);
}

std::size_t ByteReader::unpack(std::span<char> buffer) {
  Unpacking& state = *unpacking_;
  ZSTD_outBuffer output = {buffer.data(), buffer.size(), 0};
  while (output.pos == 0) {
    if (state.input.pos == state.input.size && !state.more) {
      state.input.size = input_.read(state.packed);
      state.input.pos = 0;
      if (state.input.size == 0) {
        if (!state.any) fail("an empty file; expected one that zstd packed");
        if (state.in_frame) {
          fail("ends in the middle of a zstd frame, so it was cut; expected the whole file");
        }
        return 0;
      }
      state.any = true;
    }
    const std::size_t left = ZSTD_decompressStream(state.context, &output, &state.input);
    if (ZSTD_isError(left) != 0) {
      switch (ZSTD_getErrorCode(left)) {
        case ZSTD_error_memory_allocation: throw std::bad_alloc();
        case ZSTD_error_prefix_unknown:
          fail("is no zstd, or goes on with something else; expected zstd frames alone");
        default: fail(fmt::format("cannot be unpacked: {}", ZSTD_getErrorName(left)));
      }
    }
    state.in_frame = left != 0;
    state.more = state.in_frame && output.pos == output.size;
  }
  unpacked_ += output.pos;
  if (unpacked_ > base::most_unpacked) {
    fail(fmt::format("more than {} bytes when it is unpacked; expected at most so many",
                     base::most_unpacked));
  }
  return output.pos;
}

LineReader::LineReader(const std::filesystem::path& file)
    : file_(file.string()), bytes_(file), buffer_(std::size_t{1} << 16) {}

void LineReader::refuse_longer(std::size_t size) const {
  if (size <= base::longest_text) return;
  throw base::InputError(
      file_, line_ + 1,
      fmt::format("a line of more than {} bytes; expected at most so many", base::longest_text));
}

std::string_view LineReader::take(std::size_t size) {
  refuse_longer(size);
  const std::string_view line(buffer_.data() + begin_, size);
  begin_ += size;
  if (++line_ > base::most_rows) {
    throw base::InputError(file_, line_,
                           fmt::format("more lines; expected at most {}", base::most_rows));
  }
  return line;
}

std::optional<std::string_view> LineReader::next() {
  std::size_t searched = 0;  // bytes from begin_ on that hold no LF
  for (;;) {
    const char* const from = buffer_.data() + begin_;
    const std::size_t there = end_ - begin_;
    if (const void* const found = std::memchr(from + searched, '\n', there - searched)) {
      return take(static_cast<std::size_t>(static_cast<const char*>(found) - from) + 1);
    }
    searched = there;
    refuse_longer(there);
    std::copy(from, from + there, buffer_.data());
    begin_ = 0;
    end_ = there;
    if (end_ == buffer_.size()) buffer_.resize(2 * buffer_.size());
    const std::size_t got = bytes_.read(std::span(buffer_).subspan(end_));
    end_ += got;
    if (got > 0) continue;
    if (there == 0) return std::nullopt;
    return take(there);
  }
}

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

// Reads plain files, and packed ones through libzstd.
#include "harness/files/byte_reader.h"

#include <fmt/format.h>
#include <zstd.h>
#include <zstd_errors.h>

#include <new>
#include <vector>

#include "harness/base/error.h"
#include "harness/files/row_file.h"

namespace touchstone::files {

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

}  // namespace touchstone::files

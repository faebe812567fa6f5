// The array of pairs that a module writes into, which is a chunk of ours.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>

#include "algorithms/core/pair_sink.h"
#include "harness/modules/layouts.h"
#include "harness/process/child_process.h"

namespace touchstone::modules {

class ModuleSink {
 public:
  // The buffer is empty, and outlives this.
  explicit ModuleSink(PairBuffer& buffer) : buffer_(buffer) {
    sink_ = {.pairs = theirs(buffer.end()),
             .count = 0,
             .capacity = buffer.capacity(),
             .grow = grow,
             .host = &buffer};
  }

  TouchstoneModuleSink* get() { return &sink_; }

  // Hands the pairs to the buffer. Throws process::Garbage if there are more than there is room for.
  void finish(const std::string& name) {
    if (sink_.count > buffer_.capacity()) {
      throw process::Garbage(fmt::format("{}: the sink counts {} pairs; expected at most its {}",
                                         name, sink_.count, buffer_.capacity()));
    }
    buffer_.advance(sink_.count);
  }

 private:
  static void grow(TouchstoneModuleSink* sink, std::size_t more) {
    PairBuffer& buffer = *static_cast<PairBuffer*>(sink->host);
    buffer.advance(sink->count);
    buffer.reserve(std::max<std::size_t>(more, 1));
    sink->pairs = theirs(buffer.end() - sink->count);
    sink->capacity = buffer.capacity();
    buffer.clear();
  }

  PairBuffer& buffer_;
  TouchstoneModuleSink sink_{};
};

}  // namespace touchstone::modules

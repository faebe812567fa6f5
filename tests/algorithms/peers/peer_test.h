// A test that runs for each of some peers.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "algorithms/registry.h"

namespace touchstone {

// The parameter is the algorithm's name; the test is skipped where it is not built. `find` is
// registry::find<BroadPhaseEntry> or registry::find<NarrowPhaseEntry>.
template <auto find>
class PeerTest : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    entry_ = find(GetParam());
    ASSERT_NE(entry_, nullptr);
    if (!is_built(entry_->info)) GTEST_SKIP() << entry_->info.reason;
  }
  decltype(find({})) entry_ = nullptr;
};

// The algorithm's name, as GoogleTest wants it.
inline std::string peer_test_name(const testing::TestParamInfo<const char*>& peer) {
  std::string name = peer.param;
  std::ranges::replace(name, '-', '_');
  return name;
}

}  // namespace touchstone

#include "algorithms/core/pair_sink.h"

#include <gtest/gtest.h>

namespace {

using namespace touchstone;

TEST(PairBuffer, PutsTheSmallerIndexFirstAndGrows) {
  PairBuffer buffer;
  for (std::uint32_t i = 0; i < 10'000; ++i) buffer.push(i + 1, i);
  ASSERT_EQ(buffer.size(), 10'000u);
  for (std::uint32_t i = 0; i < 10'000; ++i) EXPECT_EQ(buffer.pairs()[i], (IndexPair{i, i + 1}));
}

TEST(PairBuffer, KeepsItsMemoryWhenCleared) {
  PairBuffer buffer;
  buffer.reserve(5000);
  const std::size_t capacity = buffer.capacity();
  EXPECT_GE(capacity, 5000u);
  buffer.advance(10);
  buffer.clear();
  EXPECT_EQ(buffer.size(), 0u);
  EXPECT_EQ(buffer.capacity(), capacity);
}

TEST(PairSink, GathersItsChunksInOrderAndForgetsTheFrameBefore) {
  PairSink sink;
  sink.start(3);
  sink.chunk(2).push(5, 6);
  sink.chunk(0).push(1, 2);
  sink.chunk(0).push(3, 4);
  EXPECT_EQ(sink.size(), 3u);
  EXPECT_EQ(sink.gather(), (std::vector<IndexPair>{{1, 2}, {3, 4}, {5, 6}}));
  sink.start(1);
  EXPECT_EQ(sink.size(), 0u);
  EXPECT_TRUE(sink.gather().empty());
}

}  // namespace

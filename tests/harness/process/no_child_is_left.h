// What every work in other processes must leave behind: nothing.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>

namespace touchstone {

inline void expect_no_child_is_left() {
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

}  // namespace touchstone

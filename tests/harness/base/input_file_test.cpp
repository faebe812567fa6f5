// Files that are read: of which kinds they may be, and how much of one.
#include "harness/base/input_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <thread>

#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

std::string fault_of(const std::filesystem::path& file, std::size_t most = 100) {
  return input_fault([&] { base::read_whole(file, most, "a list"); });
}

TEST(InputFile, DevicesFoldersAndSocketsAreRefused) {
  const TemporaryFolder folder;
  EXPECT_EQ(fault_of("/dev/zero"), "/dev/zero: is a device; expected a list");
  EXPECT_THAT(fault_of(folder.path()), HasSubstr("Is a directory; expected a list"));
  EXPECT_THAT(fault_of(folder.path() / "none"), HasSubstr("No such file"));
  const std::string name = folder.path() / "socket";
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, name.c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  EXPECT_THAT(fault_of(name), HasSubstr("is a socket; expected a list"));
  close(socket);
}

TEST(InputFile, ReadsNoMoreThanItMay) {
  const TemporaryFolder folder;
  const std::string content(100'000, 'x');
  const auto file = folder.write("file", content);
  EXPECT_EQ(base::read_whole(file, content.size()), content);
  EXPECT_THAT(fault_of(file, content.size() - 1), HasSubstr("more than 99999 bytes"));
}

TEST(InputFile, APipeIsRead) {
  const TemporaryFolder folder;
  const std::string name = folder.path() / "pipe";
  ASSERT_EQ(mkfifo(name.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(name) << "of a pipe"; });
  EXPECT_EQ(base::read_whole(name, 100), "of a pipe");
  writer.join();
}

}  // namespace
}  // namespace touchstone

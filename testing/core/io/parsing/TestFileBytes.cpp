// SPDX-License-Identifier: BSD-3-Clause
#include "io/parsing/FileBytes.h"

#include "TestFiles.h"

#include <iterator>

namespace
{
int filesIn(const files::Folder& folder)
{
  return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder.path()), {}));
}
}

TEST(FileBytes, aWholeFileOrNone)
{
  const files::Folder folder;
  const std::string path = folder.path("a");
  meam::writeFile(path, "first");
  meam::writeFile(path, "second");
  EXPECT_EQ(meam::readFile(path), "second");
  EXPECT_EQ(filesIn(folder), 1) << "temporary files are left";
  const std::string missing = folder.path("no/a");
  const std::string error = files::errorOf([&] { meam::writeFile(missing, "b"); });
  EXPECT_EQ(error, "The file '" + missing + "' cannot be written: No such file or directory.");
}

TEST(FileBytes, aFullDisk)
{
  const std::string disk = "/dev/full";
  if (!std::filesystem::exists(disk))
  {
    GTEST_SKIP() << "there is no " << disk;
  }
  for (const std::size_t size : { 1, 10000000 })
  {
    const std::string error = files::errorOf([&] { meam::writeFile(disk, std::string(size, 'a')); });
    EXPECT_EQ(error, "The file '/dev/full' cannot be written: No space left on device.");
  }
}

TEST(FileBytes, aFileThatBecomesShorterWhileItIsRead)
{
  // The system promises a page of it and then has a few bytes.
  const std::string path = "/sys/devices/system/cpu/online";
  std::error_code failure;
  if (std::filesystem::file_size(path, failure) < 100 || failure)
  {
    GTEST_SKIP() << path << " is not what it is on Linux";
  }
  const std::string error = files::errorOf([&] { meam::readFile(path); });
  EXPECT_EQ(error, "The file '" + path + "' cannot be read: it was cut off while it was read.");
}

TEST(FileBytes, whatADownloadLeavesInPlaceOfAFile)
{
  const files::Folder folder;
  const std::string path = folder.path("part.stl");
  for (const auto& [bytes, what] :
    { std::pair<std::string, std::string>{ "\r\n <!DOCTYPE HTML>\n<html>", "a web page" },
      { "<html lang='en'>", "a web page" },
      { "version https://git-lfs.github.com/spec/v1\n", "a pointer of Git LFS" } })
  {
    meam::writeFile(path, bytes);
    const std::string error = files::errorOf([&] { meam::readFile(path); });
    EXPECT_NE(error.find("The file '" + path + "' cannot be read: it is " + what), std::string::npos) << error;
  }
  for (const std::string& bytes :
    { std::string(), std::string("\n\n"), std::string("solid <html>"), std::string(300, ' ') })
  {
    meam::writeFile(path, bytes);
    EXPECT_EQ(meam::readFile(path), bytes);
  }
}

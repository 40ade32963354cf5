// SPDX-License-Identifier: BSD-3-Clause
// Files of a test, and the messages that reading them gives.
#pragma once

#include "base/Error.h"
#include "io/parsing/FileBytes.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace files
{
/// A folder of the test that is running, removed at its end.
class Folder
{
public:
  explicit Folder(const std::string& place = testing::TempDir())
  {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    this->Path = std::filesystem::path(place) / (std::string("meam-") + test->test_suite_name() + "-" + test->name());
    std::filesystem::remove_all(this->Path);
    std::filesystem::create_directories(this->Path);
  }
  ~Folder() { std::filesystem::remove_all(this->Path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string path(const std::string& name = {}) const { return (this->Path / name).string(); }

  /// Writes a file, in folders that it makes, and returns its path.
  std::string write(const std::string& name, const std::string& bytes) const
  {
    const std::filesystem::path file = this->Path / name;
    std::filesystem::create_directories(file.parent_path());
    meam::writeFile(file.string(), bytes);
    return file.string();
  }

private:
  std::filesystem::path Path;
};

/// The message of the meam::Error that `work` throws; empty without.
template <typename Work>
std::string errorOf(Work&& work)
{
  try
  {
    work();
  }
  catch (const meam::Error& error)
  {
    return error.what();
  }
  return "";
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Reads files that have given bytes, by a function of the path.
template <typename Read>
struct Reader
{
  Read read;
  std::string name = "file";

  auto operator()(const std::string& bytes) const
  {
    const Folder folder;
    return this->read(folder.write(this->name, bytes));
  }

  /// An error that names the file and has these words.
  void fails(const std::string& bytes, const std::string& words) const
  {
    const Folder folder;
    const std::string path = folder.write(this->name, bytes);
    const std::string error = errorOf([&] { this->read(path); });
    EXPECT_TRUE(contains(error, words) && contains(error, path)) << bytes << "\nsays: " << error;
  }
};
template <typename Read>
Reader(Read) -> Reader<Read>;
template <typename Read>
Reader(Read, const char*) -> Reader<Read>;

template <typename T>
std::string raw(T value)
{
  return std::string(reinterpret_cast<const char*>(&value), sizeof(T));
}
}

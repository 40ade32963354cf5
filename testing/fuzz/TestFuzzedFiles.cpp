// SPDX-License-Identifier: BSD-3-Clause
// Damaged files: every reader ends with a result or with a meam::Error. Under the sanitizers also without a wrong
// access and with no more memory than its file justifies.
#include "Trial.h"

#include "model/body/BodyInterior.h"
#include "model/body/SurroundingPatches.h"
#include "model/file/ModelFile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <random>

namespace
{
namespace fs = std::filesystem;

template <typename T>
std::string raw(T value)
{
  return std::string(reinterpret_cast<const char*>(&value), sizeof(T));
}

/// Damages files as disks, networks and other programs do. The same every time.
class Damage
{
public:
  std::string operator()(std::string bytes)
  {
    for (int times = 1 + this->upTo(3); times > 0; --times)
    {
      this->once(bytes);
    }
    return bytes;
  }

  /// A whole number from 0 to `most`.
  std::size_t upTo(std::size_t most) { return this->Random() % (most + 1); }

private:
  void once(std::string& bytes)
  {
    const std::size_t at = this->upTo(bytes.size());
    const std::size_t length = std::min(this->upTo(20), bytes.size() - at);
    switch (this->upTo(7))
    {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes.erase(at, length);
        break;
      case 2:
        bytes.insert(at, bytes.substr(this->upTo(bytes.size()), length));
        break;
      case 3:
        bytes.insert(at, 1, static_cast<char>(this->upTo(255)));
        break;
      case 4:
        if (at + 4 <= bytes.size())
        {
          bytes.replace(at, 4, raw(this->oneOf<std::uint32_t>({ 0, 1, 255, 65536, 0x7fffffff, 0xffffffff })));
        }
        break;
      case 5:
        this->replaceNumber(bytes, at);
        break;
      default:
        if (at < bytes.size())
        {
          bytes[at] = static_cast<char>(bytes[at] ^ (1 << this->upTo(7)));
        }
    }
  }

  /// The next number of a text becomes an absurd one.
  void replaceNumber(std::string& bytes, std::size_t at)
  {
    constexpr const char* digits = "0123456789.";
    const std::size_t first = bytes.find_first_of(digits, at);
    if (first != std::string::npos)
    {
      const std::size_t end = std::min(bytes.find_first_not_of(digits, first), bytes.size());
      bytes.replace(first, end - first,
        this->oneOf<const char*>({ "0", "-1", "1e999", "nan", "65536", "2147483647", "4294967295",
          "18446744073709551615", "99999999999999999999", "", "\"a\"", "[", "1e-300" }));
    }
  }

  template <typename T>
  T oneOf(std::initializer_list<T> values)
  {
    return *(values.begin() + this->upTo(values.size() - 1));
  }

  std::mt19937 Random{ 5489 };
};

/// The files of a reader in one of the folders beside this: in corpus/ whole ones and those that once were trouble, in
/// reached/ those that libFuzzer made to reach what others do not.
std::vector<std::string> filesOf(const fuzz::Reader& reader, const char* folder)
{
  std::vector<fs::path> paths;
  std::error_code none; // libFuzzer reaches nothing where another process reads
  for (const auto& entry : fs::directory_iterator(fs::path(MEAM_FUZZ) / folder / reader.name, none))
  {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> files;
  for (const fs::path& path : paths)
  {
    std::ifstream file(path, std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return files;
}

/// The parameters are a reader and how many damaged files it gets.
class FuzzedFiles : public testing::TestWithParam<std::tuple<fuzz::Reader, int>>
{
};

std::string nameOf(const testing::TestParamInfo<FuzzedFiles::ParamType>& info)
{
  std::string name = std::get<0>(info.param).name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
}

INSTANTIATE_TEST_SUITE_P(
  Quick, FuzzedFiles, testing::Combine(testing::ValuesIn(fuzz::readers()), testing::Values(2000)), nameOf);
INSTANTIATE_TEST_SUITE_P(
  Long, FuzzedFiles, testing::Combine(testing::ValuesIn(fuzz::readers()), testing::Values(30000)), nameOf);

TEST_P(FuzzedFiles, areReadOrRefused)
{
  const auto& [reader, usual] = GetParam();
  const int cases = usual / reader.oneOf;
  const std::vector<std::string> kept = filesOf(reader, "corpus");
  ASSERT_FALSE(kept.empty());
  const fuzz::Trial trial(reader);
  int readable = 0;
  for (const std::string& bytes : kept)
  {
    readable += trial.reads(bytes) ? 1 : 0;
  }
  EXPECT_GT(readable, 0) << "no kept file is whole";
  for (const std::string& bytes : filesOf(reader, "reached"))
  {
    trial.reads(reader.mend ? reader.mend(bytes) : bytes);
  }

  readable = 0;
  Damage damage;
  for (int i = 0; i < cases; ++i)
  {
    const std::string bytes = damage(kept[i % kept.size()]);
    readable += trial.reads(reader.mend && i % 4 != 0 ? reader.mend(bytes) : bytes) ? 1 : 0;
  }
  EXPECT_GT(readable, 0) << "all files were refused: the damage is too large";
  EXPECT_LT(readable, cases) << "no file was refused";
}

TEST(ModelFile, HoldsWhatThisCodeDerives)
{
  // The same model without what is derived, and with what was when it was saved. Where this fails because something is
  // derived in another way, raise the version in DerivedFields.cpp, and save derived.meam anew from small.meam.
  const fs::path folder = fs::path(MEAM_FUZZ) / "corpus" / "model";
  const meam::TrainedModel derived = meam::readModel((folder / "small.meam").string());
  const meam::TrainedModel held = meam::readModel((folder / "derived.meam").string());
  EXPECT_EQ(held.surfaceDistance.stored().distances, derived.surfaceDistance.stored().distances);
  EXPECT_EQ(held.edgeDistance.stored().distances, derived.edgeDistance.stored().distances);
  EXPECT_EQ(held.interior->cells(), derived.interior->cells());
  EXPECT_EQ(held.surroundings->steps(held), derived.surroundings->steps(derived));
}

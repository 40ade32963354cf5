// SPDX-License-Identifier: BSD-3-Clause
#include "io/PCDFile.h"
#include "io/parsing/FileBytes.h"

#include <gtest/gtest.h>
#include <liblzf/lzf.h>

#include <cmath>
#include <cstring>
#include <filesystem>

namespace
{
namespace fs = std::filesystem;

/// A file of this test, removed at its end.
struct Scratch
{
  explicit Scratch(const std::string& bytes = {})
    : path(testing::TempDir() + "TestPCDFile-" + testing::UnitTest::GetInstance()->current_test_info()->name())
  {
    meam::writeFile(this->path, bytes);
  }
  ~Scratch() { fs::remove(this->path); }
  std::string path;
};

meam::MeasuredCloud read(const std::string& bytes)
{
  const Scratch file(bytes);
  return meam::readPCD(file.path);
}

/// The message of the error that reading gives.
std::string errorOf(const std::string& bytes)
{
  const Scratch file(bytes);
  try
  {
    meam::readPCD(file.path);
  }
  catch (const meam::Error& error)
  {
    EXPECT_NE(std::string(error.what()).find(file.path), std::string::npos) << error.what();
    return error.what();
  }
  return "no error";
}

template <typename T>
std::string raw(T value)
{
  return std::string(reinterpret_cast<const char*>(&value), sizeof(T));
}

const std::string xyz = "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }
}

TEST(PCDFile, asciiOrganized)
{
  const meam::MeasuredCloud data = read("# .PCD v0.7\r\n" + xyz +
                                        "WIDTH 2\nHEIGHT 2\nVIEWPOINT 1 2 3 0 1 0 0\nPOINTS 4\nDATA "
                                        "ascii\n1 2 3\n+4 5.5 -6e1\r\nnan nan nan\n7 8 9\n\n");
  EXPECT_EQ(data.cloud.width, 2);
  EXPECT_EQ(data.cloud.height, 2);
  ASSERT_EQ(data.cloud.size(), 4u);
  EXPECT_EQ(data.cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(data.cloud.points[1], Eigen::Vector3f(4, 5.5f, -60));
  EXPECT_TRUE(std::isnan(data.cloud.points[2].x()));
  EXPECT_EQ(data.cloud.points[3], Eigen::Vector3f(7, 8, 9));
  EXPECT_TRUE(data.normals.empty());
  EXPECT_TRUE(data.intensities.empty());
  EXPECT_TRUE(data.colors.empty());
}

TEST(PCDFile, sizeOfTheHeader)
{
  const Scratch file(xyz + "WIDTH 3\nHEIGHT 2\nPOINTS 6\nDATA binary\n");
  EXPECT_EQ(meam::readPCDSize(file.path), (std::array<int, 2>{ 3, 2 }));
  EXPECT_THROW(meam::readPCDSize("/no/such/file.pcd"), meam::Error);
}

TEST(PCDFile, oldHeaderWithoutSizesAndCounts)
{
  const meam::MeasuredCloud data = read("VERSION 0.5\nCOLUMNS x y z\nPOINTS 1\nDATA ascii\n1 2 3");
  EXPECT_EQ(data.cloud.width, 1);
  EXPECT_EQ(data.cloud.height, 1);
  EXPECT_EQ(data.cloud.points[0], Eigen::Vector3f(1, 2, 3));
}

TEST(PCDFile, binaryFieldsInAnyOrderAndType)
{
  const std::string header = "FIELDS intensity z _ y normal_y x normal_x normal_z rgb\n"
                             "SIZE 2 8 1 8 4 8 4 4 4\nTYPE U F U F F F F F U\nCOUNT 1 1 3 1 1 1 1 1 1\n"
                             "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary\n";
  const meam::MeasuredCloud data = read(header + raw<std::uint16_t>(513) + raw(3.0) + "pad" + raw(2.0) + raw(0.6f) +
                                        raw(1.0) + raw(0.0f) + raw(0.8f) + raw<std::uint32_t>(0xff102030));
  EXPECT_EQ(data.cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(data.normals[0], Eigen::Vector3f(0, 0.6f, 0.8f));
  EXPECT_EQ(data.intensities, std::vector<float>{ 513 });
  EXPECT_EQ(data.colors, (std::vector<std::uint8_t>{ 0x10, 0x20, 0x30 }));
}

TEST(PCDFile, colorsInABinaryFloatFieldKeepAllBits)
{
  // 0xff963456 is not a number as a float; red must not come out as another one.
  const std::string header = "FIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT 1\n"
                             "POINTS 1\nDATA binary\n";
  std::string record(12, '\0');
  for (const unsigned char byte : { 0x56, 0x34, 0x96, 0xff })
  {
    record += static_cast<char>(byte);
  }
  EXPECT_EQ(read(header + record).colors, (std::vector<std::uint8_t>{ 0x96, 0x34, 0x56 }));
}

TEST(PCDFile, colorsInAsciiAreIntegersOrTheBitsOfAFloat)
{
  const std::string header = "FIELDS x y z rgb\nSIZE 4 4 4 4\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\n";
  const std::vector<std::uint8_t> expected = { 0x10, 0x20, 0x30 };
  EXPECT_EQ(read(header + "TYPE F F F U\nDATA ascii\n1 2 3 1056816\n").colors, expected);
  // 0x00102030 read as a float.
  EXPECT_EQ(read(header + "TYPE F F F F\nDATA ascii\n1 2 3 1.48091461e-39\n").colors, expected);
  EXPECT_EQ(read(header + "TYPE F F F I\nDATA ascii\n1 2 3 -15720400\n").colors, expected); // 0xff102030
}

TEST(PCDFile, compressedIsStoredFieldByField)
{
  const int points = 200;
  std::string columns;
  for (int k = 0; k < 3; ++k)
  {
    for (int i = 0; i < points; ++i)
    {
      columns += raw(static_cast<float>(k == 0 ? i : 10 * k));
    }
  }
  for (int i = 0; i < points; ++i)
  {
    columns += raw(static_cast<std::uint8_t>(i));
  }
  std::string packed(columns.size(), '\0');
  packed.resize(lzf_compress(columns.data(), columns.size(), packed.data(), packed.size()));
  ASSERT_GT(packed.size(), 0u);
  const std::string header = "FIELDS x y z intensity\nSIZE 4 4 4 1\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 100\nHEIGHT 2\n"
                             "POINTS 200\nDATA binary_compressed\n";
  const std::string sizes = raw<std::uint32_t>(packed.size()) + raw<std::uint32_t>(columns.size());
  const meam::MeasuredCloud data = read(header + sizes + packed);
  EXPECT_EQ(data.cloud.height, 2);
  EXPECT_EQ(data.cloud.points[150], Eigen::Vector3f(150, 10, 20));
  EXPECT_EQ(data.intensities[150], 150.0f);

  EXPECT_TRUE(contains(errorOf(header), "cut off"));
  EXPECT_TRUE(contains(errorOf(header + sizes + packed.substr(1)), "cut off"));
  EXPECT_TRUE(contains(errorOf(header + raw<std::uint32_t>(packed.size()) + raw<std::uint32_t>(7) + packed), "header"));
  EXPECT_TRUE(contains(errorOf(header + sizes + std::string(packed.size(), '\xff')), "damaged"));
}

TEST(PCDFile, badFiles)
{
  EXPECT_THROW(meam::readPCD("/no/such/file.pcd"), meam::Error);
  EXPECT_THROW(meam::readPCD(testing::TempDir()), meam::Error);
  EXPECT_TRUE(contains(errorOf(""), "DATA"));
  EXPECT_TRUE(contains(errorOf("ply\nformat ascii 1.0\n"), "not a PCD file"));
  EXPECT_TRUE(contains(errorOf(xyz + "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n1 2 3\n4 5\n"), "cut off"));
  EXPECT_TRUE(contains(errorOf(xyz + "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3\n4 5 6\n"), "more values"));
  EXPECT_TRUE(contains(errorOf(xyz + "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 three\n"), "three"));
  EXPECT_TRUE(contains(errorOf(xyz + "WIDTH 2\nHEIGHT 2\nPOINTS 3\nDATA ascii\n"), "2 x 2"));
  EXPECT_TRUE(contains(errorOf(xyz + "WIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA ascii\n"), "no points"));
  EXPECT_TRUE(contains(errorOf(xyz + "WIDTH -2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n"), "WIDTH"));
  EXPECT_TRUE(contains(errorOf(xyz + "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA zipped\n"), "zipped"));
  EXPECT_TRUE(contains(errorOf(xyz + "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary\n" + std::string(23, '\0')), "cut off"));
  EXPECT_TRUE(
    contains(errorOf("FIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2\n"),
      "x, y and z"));
  EXPECT_TRUE(contains(errorOf("FIELDS x y z\nSIZE 4 4\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3\n"), "SIZE"));
  EXPECT_TRUE(contains(errorOf("FIELDS x y z\nSIZE 4 4 3\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3\n"), "SIZE"));
}

TEST(PCDFile, absurdSizesAreRefusedBeforeMemoryIsTaken)
{
  for (const std::string encoding : { "ascii", "binary", "binary_compressed" })
  {
    const std::string end = "DATA " + encoding + "\n12345678";
    EXPECT_NE(errorOf(xyz + "WIDTH 2000000000\nHEIGHT 1\nPOINTS 2000000000\n" + end), "no error");
    EXPECT_NE(errorOf(xyz + "WIDTH 4000000000\nHEIGHT 4000000000\nPOINTS 1\n" + end), "no error");
    EXPECT_NE(errorOf(xyz + "WIDTH 99999999999999999999\nHEIGHT 1\nPOINTS 1\n" + end), "no error");
    EXPECT_NE(errorOf("FIELDS x y z a\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 4000000000\nWIDTH "
                      "1\nHEIGHT 1\nPOINTS 1\n" +
                      end),
      "no error");
  }
}

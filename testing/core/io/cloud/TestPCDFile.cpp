// SPDX-License-Identifier: BSD-3-Clause
#include "io/cloud/PCDFile.h"

#include "TestFiles.h"

#include <liblzf/lzf.h>

#include <cmath>
#include <cstring>

namespace
{
const files::Reader readPCD{ [](const std::string& path) { return meam::readPCD(path); } };

const std::string xyz = "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
}

TEST(PCDFile, coloursUnderTheNamesInUse)
{
  const auto dataOf = [](const std::string& names, const std::string& type, const std::string& values)
  {
    return readPCD("FIELDS x y z " + names + "\nSIZE 4 4 4 4 4 4\nTYPE F F F " + type + " " + type + " " + type +
                   "\nCOUNT 1 1 1 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3 " + values + "\n");
  };
  EXPECT_EQ(dataOf("red green blue", "U", "10 20 30").colors, (std::vector<std::uint8_t>{ 10, 20, 30 }));
  EXPECT_EQ(dataOf("R G B", "F", "0 0.5 1").colors, (std::vector<std::uint8_t>{ 0, 128, 255 }));
  EXPECT_EQ(dataOf("r g b", "F", "0 100 255").colors, (std::vector<std::uint8_t>{ 0, 100, 255 }));
  EXPECT_EQ(dataOf("Red Green Blue", "U", "0 257 65535").colors, (std::vector<std::uint8_t>{ 0, 1, 255 }));
  EXPECT_EQ(dataOf("gray a b", "F", "40 1 1").intensities, (std::vector<float>{ 40 }));
  EXPECT_EQ(dataOf("i j k", "F", "40 1 1").intensities, (std::vector<float>{ 40 }));
}

TEST(PCDFile, asciiOrganized)
{
  const meam::MeasuredCloud data = readPCD("# .PCD v0.7\r\n" + xyz +
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
  ASSERT_TRUE(data.T_cloud_sensor);
  EXPECT_EQ(data.T_cloud_sensor->translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(data.T_cloud_sensor->linear().col(2), -Eigen::Vector3d::UnitZ());
}

TEST(PCDFile, aViewpointThatTellsNothingIsNone)
{
  for (const char* viewpoint : { "0 0 0 1 0 0 0", "1 2 3 0 0 0 0", "1 2 nan 1 0 0 0", "1 2 3", "1 2 3 1 0 0 x" })
  {
    const std::string file = xyz + "WIDTH 1\nHEIGHT 1\nVIEWPOINT " + viewpoint + "\nDATA ascii\n1 2 3\n";
    EXPECT_FALSE(readPCD(file).T_cloud_sensor) << viewpoint;
  }
}

TEST(PCDFile, asOtherProgramsWriteIt)
{
  std::string lower = xyz;
  std::replace(lower.begin() + static_cast<std::ptrdiff_t>(lower.find("TYPE") + 4), lower.end(), 'F', 'f');
  const meam::MeasuredCloud data = readPCD(
    "\xef\xbb\xbf# .PCD v0.7\n" + lower + "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ASCII\n1 2 3\n1.#QNAN -1.#IND 6\n");
  EXPECT_EQ(data.cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_TRUE(std::isnan(data.cloud.points[1].x()) && std::isnan(data.cloud.points[1].y()));
}

TEST(PCDFile, sizeOfTheHeader)
{
  const files::Folder folder;
  const std::string path = folder.write("file", xyz + "WIDTH 3\nHEIGHT 2\nPOINTS 6\nDATA binary\n");
  EXPECT_EQ(meam::readPCDSize(path), (std::array<int, 2>{ 3, 2 }));
  EXPECT_THROW(meam::readPCDSize("/no/such/file.pcd"), meam::Error);
}

TEST(PCDFile, oldHeaderWithoutSizesAndCounts)
{
  const meam::MeasuredCloud data = readPCD("VERSION 0.5\nCOLUMNS x y z\nPOINTS 1\nDATA ascii\n1 2 3");
  EXPECT_EQ(data.cloud.width, 1);
  EXPECT_EQ(data.cloud.height, 1);
  EXPECT_EQ(data.cloud.points[0], Eigen::Vector3f(1, 2, 3));
}

TEST(PCDFile, binaryFieldsInAnyOrderAndType)
{
  const std::string header = "FIELDS intensity z _ y normal_y x normal_x normal_z rgb\n"
                             "SIZE 2 8 1 8 4 8 4 4 4\nTYPE U F U F F F F F U\nCOUNT 1 1 3 1 1 1 1 1 1\n"
                             "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary\n";
  const meam::MeasuredCloud data =
    readPCD(header + files::raw<std::uint16_t>(513) + files::raw(3.0) + "pad" + files::raw(2.0) + files::raw(0.6f) +
            files::raw(1.0) + files::raw(0.0f) + files::raw(0.8f) + files::raw<std::uint32_t>(0xff102030));
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
  EXPECT_EQ(readPCD(header + record).colors, (std::vector<std::uint8_t>{ 0x96, 0x34, 0x56 }));
}

TEST(PCDFile, colorsInAsciiAreIntegersOrTheBitsOfAFloat)
{
  const std::string header = "FIELDS x y z rgb\nSIZE 4 4 4 4\nCOUNT 1 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\n";
  const std::vector<std::uint8_t> expected = { 0x10, 0x20, 0x30 };
  EXPECT_EQ(readPCD(header + "TYPE F F F U\nDATA ascii\n1 2 3 1056816\n").colors, expected);
  // 0x00102030 read as a float.
  EXPECT_EQ(readPCD(header + "TYPE F F F F\nDATA ascii\n1 2 3 1.48091461e-39\n").colors, expected);
  EXPECT_EQ(readPCD(header + "TYPE F F F I\nDATA ascii\n1 2 3 -15720400\n").colors, expected); // 0xff102030
}

TEST(PCDFile, compressedIsStoredFieldByField)
{
  const int points = 200;
  std::string columns;
  for (int k = 0; k < 3; ++k)
  {
    for (int i = 0; i < points; ++i)
    {
      columns += files::raw(static_cast<float>(k == 0 ? i : 10 * k));
    }
  }
  for (int i = 0; i < points; ++i)
  {
    columns += files::raw(static_cast<std::uint8_t>(i));
  }
  std::string packed(columns.size(), '\0');
  packed.resize(lzf_compress(columns.data(), columns.size(), packed.data(), packed.size()));
  ASSERT_GT(packed.size(), 0u);
  const std::string header = "FIELDS x y z intensity\nSIZE 4 4 4 1\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 100\nHEIGHT 2\n"
                             "POINTS 200\nDATA binary_compressed\n";
  const std::string sizes = files::raw<std::uint32_t>(packed.size()) + files::raw<std::uint32_t>(columns.size());
  const meam::MeasuredCloud data = readPCD(header + sizes + packed);
  EXPECT_EQ(data.cloud.height, 2);
  EXPECT_EQ(data.cloud.points[150], Eigen::Vector3f(150, 10, 20));
  EXPECT_EQ(data.intensities[150], 150.0f);

  readPCD.fails(header, "cut off");
  readPCD.fails(header + sizes + packed.substr(1), "cut off");
  readPCD.fails(header + files::raw<std::uint32_t>(packed.size()) + files::raw<std::uint32_t>(7) + packed, "header");
  readPCD.fails(header + sizes + std::string(packed.size(), '\xff'), "damaged");
}

TEST(PCDFile, badFiles)
{
  EXPECT_THROW(meam::readPCD("/no/such/file.pcd"), meam::Error);
  EXPECT_THROW(meam::readPCD(testing::TempDir()), meam::Error);
  readPCD.fails("", "DATA");
  readPCD.fails("ply\nformat ascii 1.0\n", "not a PCD file");
  readPCD.fails(xyz + "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n1 2 3\n4 5\n", "cut off");
  readPCD.fails(xyz + "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3\n4 5 6\n", "more values");
  readPCD.fails(xyz + "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 three\n", "three");
  readPCD.fails(xyz + "WIDTH 2\nHEIGHT 2\nPOINTS 3\nDATA ascii\n", "2 x 2");
  readPCD.fails(xyz + "WIDTH 0\nHEIGHT 1\nPOINTS 0\nDATA ascii\n", "no points");
  readPCD.fails(xyz + "WIDTH -2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n", "WIDTH");
  readPCD.fails(xyz + "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA zipped\n", "zipped");
  readPCD.fails(xyz + "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary\n" + std::string(23, '\0'), "cut off");
  readPCD.fails(
    "FIELDS x y\nSIZE 4 4\nTYPE F F\nCOUNT 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2\n", "x, y and z");
  readPCD.fails(
    "FIELDS rgb\nSIZE 4\nTYPE U\nCOUNT 1\nWIDTH 1\nHEIGHT 2\nPOINTS 2\nDATA ascii\n1\n2\n", "it is an image");
  readPCD.fails("FIELDS x y z\nSIZE 4 4\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3\n", "SIZE");
  readPCD.fails("FIELDS x y z\nSIZE 4 4 3\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3\n", "SIZE");
}

TEST(PCDFile, absurdSizesAreRefusedBeforeMemoryIsTaken)
{
  for (const std::string encoding : { "ascii", "binary", "binary_compressed" })
  {
    const std::string end = "DATA " + encoding + "\n12345678";
    readPCD.fails(xyz + "WIDTH 2000000000\nHEIGHT 1\nPOINTS 2000000000\n" + end, "");
    readPCD.fails(xyz + "WIDTH 4000000000\nHEIGHT 4000000000\nPOINTS 1\n" + end, "");
    readPCD.fails(xyz + "WIDTH 99999999999999999999\nHEIGHT 1\nPOINTS 1\n" + end, "");
    readPCD.fails("FIELDS x y z a\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 4000000000\nWIDTH "
                  "1\nHEIGHT 1\nPOINTS 1\n" +
                    end,
      "");
  }
}

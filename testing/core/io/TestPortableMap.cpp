// SPDX-License-Identifier: BSD-3-Clause
#include "io/PortableMap.h"

#include "TestFiles.h"
#include "TestImages.h"

#include <cmath>

namespace
{
/// The values of a file of these bytes, row by row; 0 for none.
std::vector<float> depthsIn(const std::string& bytes, int width = 3, int height = 2)
{
  const files::Folder folder;
  const std::string path = folder.write("depth", bytes);
  EXPECT_EQ(meam::readImageSize(path), (std::array<int, 2>{ width, height }));
  std::vector<float> values = meam::readDepthPixels(path).pixels;
  std::replace_if(
    values.begin(), values.end(), [](float value) { return std::isnan(value); }, 0.0f);
  return values;
}

const files::Reader readDepths{ &meam::readDepthPixels };
const std::string numbers("\0\0\x13\x88\xff\xff\0\1\0\2\0\3", 12); // 0, 5000, 65535, 1, 2, 3
}

TEST(PortableMap, wholeNumbersAsTheyAre)
{
  const std::vector<float> expected{ 0, 5000, 0, 1, 2, 3 };
  EXPECT_EQ(depthsIn("P5\n3 2\n65535\n" + numbers), expected);
  EXPECT_EQ(depthsIn("P5 # of a sensor\n# mm\n 3 2\t65535 " + numbers + "behind it"), expected);
  EXPECT_EQ(depthsIn("P5\r\n3 2\r\n65535\r\n" + numbers), expected);
  EXPECT_EQ(depthsIn("P2\n# mm\n3 2\n65535\n0 5000 65535\n1 2 3"), expected);
  EXPECT_EQ(depthsIn("P2 3 2 5000 0 5000 0 1\r\n2 3\n"), expected);
  EXPECT_EQ(depthsIn("P5 3 2 255\n" + std::string("\0\x80\xff\1\2\3", 6)), (std::vector<float>{ 0, 128, 0, 1, 2, 3 }));
  // Others stretch 8 bits to their whole range.
  EXPECT_EQ(depthsIn("P5 3 2 100\n" + std::string("\0\x50\x64\1\2\3", 6)), (std::vector<float>{ 0, 80, 100, 1, 2, 3 }));
  const cv::Mat image = (cv::Mat_<std::uint16_t>(2, 3) << 0, 5000, 65535, 1, 2, 3);
  EXPECT_EQ(depthsIn(images::encoded(".pgm", image)), expected);
}

TEST(PortableMap, realNumbersOfBothByteOrdersFromTheBottom)
{
  const std::string big("\x3f\xc0\0\0\x7f\xc0\0\0\xbf\x80\0\0\x40\0\0\0\x42\xc8\0\0\x7f\x80\0\0", 24);
  std::string little;
  for (std::size_t i = 0; i < big.size(); ++i)
  {
    little += big[i / 4 * 4 + 3 - i % 4];
  }
  const std::vector<float> expected{ 2, 100, 0, 1.5f, 0, 0 };
  EXPECT_EQ(depthsIn("Pf\n3 2\n1.0\n" + big), expected);
  EXPECT_EQ(depthsIn("Pf\n3 2\n-1.000000\n" + little), expected);
  EXPECT_EQ(depthsIn(images::encoded(".pfm", (cv::Mat_<float>(2, 3) << 2, 100, NAN, 1.5f, -1, 0))), expected);
}

TEST(PortableMap, badFiles)
{
  readDepths.fails("Pf 1 1 -0.0039\n0123", "has a scale of -0.0039, which programs take in different ways: write -1.0");
  for (const char* scale : { "0", "nan", "x" })
  {
    readDepths.fails(std::string("Pf 1 1 ") + scale + "\n0123", "its scale is '");
  }
  for (const char* most : { "0", "65536", "x", "-1" })
  {
    readDepths.fails(std::string("P5 1 1 ") + most + "\n0123", "its largest value is '");
  }
  for (const char* header : { "P5\n", "P5 3", "P5 3 2 ", "Pf x 2 -1\n", "P2 3 -2 9\n", "P5 0 2 9\n" })
  {
    readDepths.fails(header, "its header has no size");
  }
  for (const std::string& cut :
    { "P5 3 2 65535\n" + numbers.substr(0, 11), "Pf 3 1 -1\n" + numbers.substr(0, 11),
      std::string("P2 3 2 9 0 1 2 3 4"), std::string("P2 3 2 9 0 1 2 3 4 10"), std::string("P2 3 2 9 0 1 2 -3 4 5") })
  {
    readDepths.fails(cut, "is cut off or damaged");
  }
  readDepths.fails("P5 60000 60000 255\n0", "more than the file has room for");
  const files::Folder folder;
  const std::string grey = folder.write("grey.pgm", "P5 1 1 255\n0");
  EXPECT_TRUE(files::contains(files::errorOf([&] { meam::readImage(grey); }), "read as a depth image alone"));
}

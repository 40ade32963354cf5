// SPDX-License-Identifier: BSD-3-Clause
#include "TestFiles.h"
#include "io/cloud/XYZFile.h"

namespace
{
const files::Reader readXYZ{ [](const std::string& path) { return meam::readXYZ(path); } };
using Colors = std::vector<std::uint8_t>;

void expectPoint(const meam::MeasuredCloud& data, int index, float x, float y, float z)
{
  ASSERT_LT(index, static_cast<int>(data.cloud.size()));
  EXPECT_EQ(data.cloud.points[index], Eigen::Vector3f(x, y, z));
}
}

TEST(XYZFile, whatStandsBetweenNumbers)
{
  for (const char* text : { "1 2.5 3\n-4 5 6e1\n", "1,2.5,3\r\n-4,5,6e1", "1, 2.5, 3\n-4, 5, 6e1,\n",
         "1;2,5;3\n-4;5;6e1\n", "1\t2,5\t3\n\n-4\t5\t60\n", "  1   2,5 \t 3\n  -4 5 60 \x1a", "2\n1 2.5 3\n-4 5 60",
         "\xef\xbb\xbf"
         "1;2.5;3;\n-4;5;+60;" })
  {
    const meam::MeasuredCloud data = readXYZ(text);
    ASSERT_EQ(data.cloud.size(), 2u) << text;
    EXPECT_EQ(data.cloud.height, 1);
    expectPoint(data, 0, 1, 2.5f, 3);
    expectPoint(data, 1, -4, 5, 60);
    EXPECT_TRUE(data.colors.empty() && data.normals.empty() && data.intensities.empty()) << text;
  }
}

TEST(XYZFile, columnsByTheirNames)
{
  const Colors color{ 7, 8, 9 };
  for (const char* text :
    { "//X Y Z R G B Nx Ny Nz\n1\n1 2 3 7 8 9 0 0 1\n", "# x y z red green blue nx ny nz\n1 2 3 7 8 9 0 0 1",
      "\"Points:0\",\"Points:1\",\"Points:2\",\"RGB:0\",\"RGB:1\",\"RGB:2\",\"Normals:0\",\"Normals:1\",\"Normals:2\"\n"
      "1,2,3,7,8,9,0,0,1\n",
      "id;X (mm);Y [mm];Z;nx;ny;nz;r;g;b;time;a;b;c\n0;1,0;2,0;3,0;0;0;1;7;8;9;0;0;0;0" })
  {
    const meam::MeasuredCloud data = readXYZ(text);
    expectPoint(data, 0, 1, 2, 3);
    EXPECT_EQ(data.colors, color) << text;
    ASSERT_EQ(data.normals.size(), 1u) << text;
    EXPECT_EQ(data.normals[0], Eigen::Vector3f(0, 0, 1)) << text;
  }
  EXPECT_EQ(readXYZ("z y x intensity\n3 2 1 0.5").cloud.points[0], Eigen::Vector3f(1, 2, 3)) << "in any order";
  EXPECT_EQ(readXYZ("z y x intensity\n3 2 1 0.5").intensities, std::vector<float>{ 0.5f });
  const meam::MeasuredCloud labelled = readXYZ("name;time;x;y;z\n# comment\na;12:30;1;2;3\n# another\n;;4;5;6\n");
  ASSERT_EQ(labelled.cloud.size(), 2u) << "other columns need not be numbers";
  expectPoint(labelled, 1, 4, 5, 6);
  expectPoint(readXYZ("x,y,z\n1 2 3\n"), 0, 1, 2, 3);
  const meam::MeasuredCloud numbered = readXYZ(",0,1,2\n0,1.0,2.0,3.0\n1,4.0,5.0,6.0\n");
  ASSERT_EQ(numbered.cloud.size(), 2u) << "rows and columns by their numbers";
  expectPoint(numbered, 1, 4, 5, 6);
  EXPECT_EQ(readXYZ("x y z r g b\n1 2 3 0 1 1\n").colors, (Colors{ 0, 255, 255 }));
}

TEST(XYZFile, columnsWithoutNames)
{
  EXPECT_EQ(readXYZ("1 2 3 0.5\n").intensities, std::vector<float>{ 0.5f });
  EXPECT_EQ(readXYZ("1 2 3 7 8 9\n").colors, (Colors{ 7, 8, 9 }));
  EXPECT_EQ(readXYZ("1 2 3 0.2 0.4 1\n").colors, (Colors{ 51, 102, 255 }));
  const meam::MeasuredCloud normal = readXYZ("1 2 3 0.6 -0.8 0\n1 2 3 nan nan nan\n");
  EXPECT_TRUE(normal.colors.empty());
  EXPECT_EQ(normal.normals[0], Eigen::Vector3f(0.6f, -0.8f, 0));
  EXPECT_EQ(readXYZ("1 2 3 -700 7 8 9\n").colors, (Colors{ 7, 8, 9 })) << "behind an intensity";
  EXPECT_EQ(readXYZ("1\n1 2 3 50 7 8 9\n").colors, (Colors{ 7, 8, 9 })) << "in a PTS file, too";
  EXPECT_EQ(readXYZ("1 2 3 7 8 9 255\n").colors, (Colors{ 7, 8, 9 })) << "with what is behind it";
  const meam::MeasuredCloud all = readXYZ("1 2 3 7 8 9 0 0 -1\n4 5 6 10 11 12 0 1 0\n");
  EXPECT_EQ(all.colors, (Colors{ 7, 8, 9, 10, 11, 12 }));
  EXPECT_EQ(all.normals[1], Eigen::Vector3f(0, 1, 0));
  EXPECT_TRUE(readXYZ("1 2 3 5.5 -3 7\n").colors.empty()) << "of no known kind";
}

TEST(XYZFile, numbersOfLinesAndPlacesOfAnImageAreNoCoordinates)
{
  std::string numbered, places, byColumns, grid;
  for (int i = 0; i < 24; ++i)
  {
    const std::string point = std::to_string(i % 5) + ".5 7 900", row = std::to_string(i / 6),
                      column = std::to_string(i % 6);
    numbered += std::to_string(i + 1) + " " + point + " 1 2 3\n";
    places += row + " " + column + " " + point + "\n";
    byColumns += column + " " + row + " " + point + " 10 20 30\n";
    grid += column + " " + row + " 900 10 20 30\n";
  }
  for (const std::string* text : { &numbered, &places, &byColumns })
  {
    const meam::MeasuredCloud data = readXYZ(*text);
    ASSERT_EQ(data.cloud.size(), 24u);
    expectPoint(data, 0, 0.5f, 7, 900);
    expectPoint(data, 23, 3.5f, 7, 900);
    EXPECT_EQ(data.colors.empty(), text == &places) << *text;
    EXPECT_TRUE(data.intensities.empty());
  }
  expectPoint(readXYZ(grid), 7, 1, 1, 900);
  expectPoint(readXYZ("1 2.5 3 4\n2 3.5 3 4\n"), 1, 2, 3.5f, 3);
}

TEST(XYZFile, whatWasNotMeasuredIsNaN)
{
  const meam::MeasuredCloud data = readXYZ("x,y,z\n,,\nnan,NaN,-\n1,2,3\n1.#QNAN,2,3\nnull,2,3\n");
  ASSERT_EQ(data.cloud.size(), 5u) << "a line of the grid each";
  for (const int i : { 0, 1, 3, 4 })
  {
    EXPECT_FALSE(data.cloud.points[i].allFinite()) << i;
  }
  expectPoint(data, 2, 1, 2, 3);
  const meam::MeasuredCloud tabs = readXYZ("x\ty\tz\tintensity\n1\t2\t3\t\n\t\t\t\n\t\t\t30\n");
  ASSERT_EQ(tabs.cloud.size(), 3u);
  expectPoint(tabs, 0, 1, 2, 3);
  EXPECT_EQ(tabs.intensities[2], 30.0f);
}

TEST(XYZFile, whatIsNoTextOfPoints)
{
  readXYZ.fails("", "no line");
  readXYZ.fails("# nothing\n", "no line");
  readXYZ.fails("1 2\n", "line 1 has '1 2' where a point's");
  readXYZ.fails("1 2 1e400\n", "line 1 has '1 2 1e400'");
  readXYZ.fails(std::string("1 2 3\n\0", 7), "not a text");
  readXYZ.fails("X Y Z\n", "no point after 'X Y Z'");
  readXYZ.fails("X Y Z\n1 2 abc\n", "line 2 has '1 2 abc'");
  readXYZ.fails("time,value,size\n1,2,3\n", "name x, y and z among them");
  readXYZ.fails("first\nsecond\n1 2 3\n", "line 2 has 'second'");
  readXYZ.fails("x y z\n1 2 3\n4 5\n", "line 3 has 2 words, where the first point has 3");
  readXYZ.fails(
    "-148,399,-118,688,601,450\n-147,780,-118,050,601,400\n", "line 2 has '050' as a number: where numbers have");
  readXYZ.fails("x,y,z\n1,050,2,000,3,100\n", "decimal commas");
  EXPECT_EQ(readXYZ("0,-0.5,0\n").cloud.points[0], Eigen::Vector3f(0, -0.5f, 0));
  readXYZ.fails("1 2 3\r\n4 5 6\r\n4 b 6\r\n", "line 3 has 'b'");
  readXYZ.fails("1 2 3\n4 5 6 7 8 9\n", "line 2 has 6 words");
  readXYZ.fails("3\n1 2 3\n4 5 6\n", "promises 3 points and has 2");
  readXYZ.fails("1 2 3 4 5 6 7 8 9 10 11\n", "has 11 numbers: name the columns");
}

TEST(XYZFile, isToldByItsBeginning)
{
  const files::Folder folder;
  EXPECT_TRUE(meam::isXYZ(folder.write("a.csv", "x,y,z\n1,2,3\n")));
  EXPECT_FALSE(meam::isXYZ(folder.write("b.csv", "scene_id,im_id,obj_id,score,R,t,time\n1,2,3,0.5,1 0 0,1 2 3,-1\n")));
  EXPECT_TRUE(meam::isXYZ(folder.write("c.txt", std::string("\xff\xfe"
                                                            "1\0 \0"
                                                            "2\0 \0"
                                                            "3\0",
                                                  12))))
    << "in UTF-16";
  EXPECT_FALSE(meam::isXYZ("/no/such/file.xyz"));
}

// SPDX-License-Identifier: BSD-3-Clause
#include "TestFiles.h"
#include "io/PLYFile.h"

#include <cmath>

namespace
{
const files::Reader readPLY{ [](const std::string& path) { return meam::readPLYCloud(path); }, "cloud.ply" };

const std::string floats = "property float x\nproperty float y\nproperty float z\n";

std::string head(const std::string& format, const std::string& elements)
{
  return "ply\nformat " + format + " 1.0\ncomment of a test\n" + elements + "end_header\n";
}
}

TEST(PLYFile, asciiWithIntensities)
{
  const meam::MeasuredCloud data = readPLY(
    head("ascii", "element vertex 2\n" + floats + "property float intensity\n") + "1 +2 -3.5 7\r\nnan nan nan 2e2\n");
  ASSERT_EQ(data.cloud.size(), 2u);
  EXPECT_EQ(data.cloud.width, 2);
  EXPECT_EQ(data.cloud.height, 1);
  EXPECT_EQ(data.cloud.points[0], Eigen::Vector3f(1, 2, -3.5f));
  EXPECT_TRUE(std::isnan(data.cloud.points[1].x()));
  EXPECT_EQ(data.intensities, (std::vector<float>{ 7, 200 }));
  EXPECT_TRUE(data.normals.empty() && data.colors.empty());
}

TEST(PLYFile, binaryOfEitherByteOrder)
{
  const std::string elements = "element vertex 1\nproperty uchar red\nproperty double x\nproperty int16 y\n"
                               "property uchar green\nproperty float z\nproperty uchar blue\nproperty float nz\n"
                               "property float ny\nproperty float nx\nobj_info nothing\n";
  const std::string x = files::raw(1.5);
  const std::string y = files::raw<std::int16_t>(-300);
  const std::string z = files::raw(3.0f);
  const std::string n = files::raw(1.0f) + files::raw(0.5f) + files::raw(0.25f);
  const std::string little = "\x0a" + x + y + "\x14" + z + "\xff" + n;
  const auto turned = [](const std::string& bytes) { return std::string(bytes.rbegin(), bytes.rend()); };
  const std::string big = "\x0a" + turned(x) + turned(y) + "\x14" + turned(z) + "\xff" + turned(files::raw(1.0f)) +
                          turned(files::raw(0.5f)) + turned(files::raw(0.25f));
  for (const auto& [format, bytes] : { std::pair{ "binary_little_endian", little }, { "binary_big_endian", big } })
  {
    const meam::MeasuredCloud data = readPLY(head(format, elements) + bytes);
    EXPECT_EQ(data.cloud.points[0], Eigen::Vector3f(1.5f, -300, 3)) << format;
    EXPECT_EQ(data.normals[0], Eigen::Vector3f(0.25f, 0.5f, 1)) << format;
    EXPECT_EQ(data.colors, (std::vector<std::uint8_t>{ 10, 20, 255 })) << format;
  }
}

TEST(PLYFile, otherElementsAndListsAreSkipped)
{
  const std::string elements = "element face 2\nproperty list uchar int vertex_indices\nproperty uchar quality\n"
                               "element vertex 1\n" +
                               floats + "property list uchar float more\nelement edge 9\nproperty int vertex1\n";
  const std::string ascii = "3 0 1 2 9\n0 8\n4 5 6 2 0.1 0.2\n";
  EXPECT_EQ(readPLY(head("ascii", elements) + ascii).cloud.points[0], Eigen::Vector3f(4, 5, 6));
  const std::string binary = "\x03" + std::string(12, '\1') + "\x09" + std::string(1, '\0') + "\x08" +
                             files::raw(4.0f) + files::raw(5.0f) + files::raw(6.0f) + "\x02" + std::string(8, '\1');
  EXPECT_EQ(readPLY(head("binary_little_endian", elements) + binary).cloud.points[0], Eigen::Vector3f(4, 5, 6));
}

TEST(PLYFile, coloursOfAnyRange)
{
  const auto colorsOf = [](const std::string& type, const std::string& values)
  {
    return readPLY(head("ascii", "element vertex 1\n" + floats + "property " + type + " red\nproperty " + type +
                                   " green\nproperty " + type + " blue\n") +
                   "1 2 3 " + values)
      .colors;
  };
  EXPECT_EQ(colorsOf("float", "0 0.5 1"), (std::vector<std::uint8_t>{ 0, 128, 255 }));
  EXPECT_EQ(colorsOf("float", "0 0.5 7"), (std::vector<std::uint8_t>{ 0, 1, 7 }));
  EXPECT_EQ(colorsOf("double", "12 254.6 255"), (std::vector<std::uint8_t>{ 12, 255, 255 }));
  EXPECT_EQ(colorsOf("ushort", "0 12 255"), (std::vector<std::uint8_t>{ 0, 12, 255 }));
  EXPECT_EQ(colorsOf("ushort", "0 257 65535"), (std::vector<std::uint8_t>{ 0, 1, 255 }));
  EXPECT_EQ(colorsOf("int", "-1 300 nan"), (std::vector<std::uint8_t>{ 0, 255, 0 }));
  const meam::MeasuredCloud short_ =
    readPLY(head("ascii", "element vertex 1\n" + floats + "property uchar r\nproperty uchar g\nproperty uchar b\n") +
            "1 2 3 4 5 6");
  EXPECT_EQ(short_.colors, (std::vector<std::uint8_t>{ 4, 5, 6 }));
  const meam::MeasuredCloud grey =
    readPLY(head("ascii", "element vertex 1\n" + floats + "property float i\n") + "1 2 3 40");
  EXPECT_EQ(grey.intensities, (std::vector<float>{ 40 }));
  const meam::MeasuredCloud upper =
    readPLY(head("ascii", "element vertex 1\nproperty float X\nproperty float Y\nproperty "
                          "float Z\nproperty uchar Red\nproperty uchar Green\nproperty "
                          "uchar Blue\n") +
            "1 2 3 4 5 6");
  EXPECT_EQ(upper.cloud.points[0], Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(upper.colors, (std::vector<std::uint8_t>{ 4, 5, 6 }));
}

TEST(PLYFile, linesOfAnyEnd)
{
  const std::string text = head("ascii", "element vertex 2\n" + floats) + "1 2 3\n4 5 6\n";
  for (const std::string end : { "\r", "\r\n" })
  {
    std::string other;
    for (const char letter : text)
    {
      other += letter == '\n' ? end : std::string(1, letter);
    }
    EXPECT_EQ(readPLY(other).cloud.points, readPLY(text).cloud.points);
  }
  EXPECT_EQ(readPLY("\xef\xbb\xbf" + std::string(text).insert(4, "\n")).cloud.points, readPLY(text).cloud.points);
  // A binary file's data may begin with the byte of a line's end.
  const std::string binary = head("binary_little_endian", "element vertex 1\n" + floats);
  std::string other;
  for (const char letter : binary)
  {
    other += letter == '\n' ? '\r' : letter;
  }
  const std::string data = files::raw(std::uint32_t(0x4000000a)) + files::raw(5.0f) + files::raw(6.0f);
  EXPECT_EQ(readPLY(other + data).cloud.points[0].y(), 5.0f);
}

TEST(PLYFile, cloudsAndMeshes)
{
  const files::Folder folder;
  EXPECT_TRUE(meam::isPLYCloud(folder.write("a", head("ascii", "element vertex 2\n" + floats))));
  EXPECT_FALSE(meam::isPLYCloud(
    folder.write("b", head("ascii", "element vertex 2\n" + floats + "element face 1\nproperty list uchar int v\n"))));
  EXPECT_FALSE(meam::isPLYCloud(folder.write("c", head("ascii", "element vertex 0\n" + floats))));
  EXPECT_FALSE(meam::isPLYCloud(folder.write("d", "solid part\n")));
  EXPECT_FALSE(meam::isPLYCloud(folder.path("none")));
}

TEST(PLYFile, stripsOfTriangles)
{
  const files::Reader readMesh{ [](const std::string& path) { return meam::readPLYMesh(path); }, "mesh.ply" };
  const auto withStrip = [](const std::string& points)
  {
    return head(
             "ascii", "element vertex 5\n" + floats + "element tristrips 1\nproperty list int int vertex_indices\n") +
           "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n" + points + "\n";
  };
  // Of 2 2 on the strip goes on without a triangle; every second one is turned round, so that all face one way.
  const meam::TriangleMesh mesh = readMesh(withStrip("10 0 1 2 3 -1 2 3 4 4 -1"));
  const std::vector<Eigen::Vector3i> triangles{ { 0, 1, 2 }, { 1, 3, 2 }, { 2, 3, 4 } };
  EXPECT_EQ(mesh.triangles, triangles);
  readMesh.fails(withStrip("4 0 1 2 5"), "a point that does not exist");
  readMesh.fails(withStrip("4 0 1 2 -2"), "a point that does not exist");
  readMesh.fails(withStrip("4 0 1 2 3.5"), "a point that does not exist");
  const files::Folder folder;
  EXPECT_FALSE(meam::isPLYCloud(folder.write("strips", withStrip("3 0 1 2"))));
}

TEST(PLYFile, linesThatOtherProgramsWrite)
{
  // Blender 2.4 has no word comment before its name, MeshLab colors of three corners where its header has one.
  const std::string face = "element face 2\nproperty list uchar int vertex_indices\n", points = "0 0 0\n1 0 0\n0 1 0\n";
  const std::string colored = face + "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  const files::Folder folder;
  const auto mesh = [&](const std::string& header, const std::string& data)
  { return meam::readPLYMesh(folder.write("mesh.ply", head("ascii", header) + points + data)); };
  EXPECT_EQ(
    mesh("Created by Blender3D\nelement vertex 3\n" + floats + face, "3 0 1 2\n3 2 1 0\n").triangles.size(), 2u);
  const meam::TriangleMesh cut =
    mesh("element vertex 3\n" + floats + colored, "3 0 1 2 9 1 1 1 1 1 1 1 1 1\n3 2 1 0 9 1 1 1 1 1 1 1 1 1\n");
  ASSERT_EQ(cut.triangles.size(), 2u);
  EXPECT_EQ(cut.triangles[1], Eigen::Vector3i(2, 1, 0));
  EXPECT_EQ(mesh("element vertex 3\n" + floats + face, "3 0 1 2 3 2 1 0").triangles.size(), 2u);
  EXPECT_THROW(mesh("element vertex 3\n" + floats + face, "3 0 1 2 7 3 2 1 0"), meam::Error);
  EXPECT_THROW(mesh("element vertex 3\n" + floats + face, "3 0 1 2 1\n3 2 1 0 1\n"), meam::Error) << "no colors";
  EXPECT_THROW(mesh("element vertex 3\n" + floats + "elemnt face 2\n" + face, "3 0 1 2\n3 2 1 0\n"), meam::Error);
  const std::string nan = "1.#QNAN -1.#IND 1.#INF\n";
  EXPECT_TRUE(readPLY(head("ascii", "element vertex 1\n" + floats) + nan).cloud.points[0].array().isNaN().all());
}

TEST(PLYFile, badFiles)
{
  EXPECT_THROW(meam::readPLYCloud("/no/such/file.ply"), meam::Error);
  readPLY.fails("", "not a PLY file");
  readPLY.fails("solid part\nfacet\n", "not a PLY file");
  readPLY.fails("ply\nformat ascii 1.0\nelement vertex 1\n" + floats, "end_header");
  readPLY.fails("ply\nelement vertex 1\n" + floats + "end_header\n1 2 3\n", "no line format");
  readPLY.fails(head("zipped", "element vertex 1\n" + floats) + "1 2 3\n", "zipped");
  readPLY.fails(head("ascii", floats), "before the first element");
  readPLY.fails(head("ascii", "elephant vertex 1\n" + floats), "elephant");
  readPLY.fails(head("ascii", "element vertex -1\n" + floats), "-1");
  readPLY.fails(head("ascii", "element vertex 1\nproperty quad x\n"), "quad");
  readPLY.fails(head("ascii", "element face 1\n" + floats) + "1 2 3\n", "no points");
  readPLY.fails(head("ascii", "element vertex 0\n" + floats), "no points");
  readPLY.fails(head("ascii", "element vertex 1\nproperty float x\nproperty float z\n") + "1 2\n", "x, y and z");
  readPLY.fails(head("ascii", "element vertex 1\n" + floats) + "1 2\n", "cut off");
  readPLY.fails(head("ascii", "element vertex 1\n" + floats) + "1 2 up\n", "up");
  readPLY.fails(head("binary_little_endian", "element vertex 1\n" + floats) + std::string(11, '\0'), "cut off");
  const std::string lists = "element vertex 1\nproperty list float int v\n" + floats;
  readPLY.fails(head("ascii", lists) + "-1 1 2 3 4 5\n", "impossible length in its element 'vertex'");
  readPLY.fails(head("ascii", lists) + "0.5 1 2 3 4 5\n", "impossible length");
  readPLY.fails(head("ascii", lists) + "4e9 1 2 3 4 5\n", "cut off");
}

TEST(PLYFile, absurdSizesAreRefusedBeforeMemoryIsTaken)
{
  for (const std::string format : { "ascii", "binary_little_endian", "binary_big_endian" })
  {
    readPLY.fails(head(format, "element vertex 2000000000\n" + floats) + "12345678", "cut off");
    readPLY.fails(head(format, "element vertex 3000000000\n" + floats) + "12345678", "impossible number");
    readPLY.fails(head(format, "element vertex 18446744073709551616\n" + floats), "18446744073709551616");
    readPLY.fails(head(format, "element face 18446744073709551615\nelement vertex 1\n" + floats), "cut off");
    readPLY.fails(
      head(format, "element face 18446744073709551615\nproperty char a\nelement vertex 1\n" + floats), "cut off");
  }
}

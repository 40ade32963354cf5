// SPDX-License-Identifier: BSD-3-Clause
#include "io/OFFFile.h"
#include "io/parsing/FileBytes.h"
#include "mesh/TriangleMesh.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace
{
/// A file of this test, removed at its end.
struct Scratch
{
  explicit Scratch(const std::string& bytes)
    : path(testing::TempDir() + "TestOFFFile-" + testing::UnitTest::GetInstance()->current_test_info()->name())
  {
    meam::writeFile(this->path, bytes);
  }
  ~Scratch() { std::filesystem::remove(this->path); }
  std::string path;
};

meam::TriangleMesh read(const std::string& bytes)
{
  const Scratch file(bytes);
  return meam::readOFF(file.path);
}

/// Reading gives an error that names the file and has these words.
void expectError(const std::string& bytes, const std::string& words)
{
  const Scratch file(bytes);
  try
  {
    meam::readOFF(file.path);
    ADD_FAILURE() << "no error: " << words;
  }
  catch (const meam::Error& error)
  {
    EXPECT_NE(std::string(error.what()).find(file.path), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

const std::string square = "4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
const std::string corners = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
}

TEST(OFFFile, trianglesAndPolygons)
{
  const meam::TriangleMesh mesh = read("OFF\n5 2 0\n0 0 0\n1.5 0 0\n+1 1e0 0\n0 1 -2.5\n0 .5 0\n3 0 1 2\n4 0 2 3 4\n");
  ASSERT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.vertices[1], Eigen::Vector3f(1.5f, 0, 0));
  EXPECT_EQ(mesh.vertices[2], Eigen::Vector3f(1, 1, 0));
  EXPECT_EQ(mesh.vertices[3], Eigen::Vector3f(0, 1, -2.5f));
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[0], Eigen::Vector3i(0, 1, 2));
  EXPECT_EQ(mesh.triangles[1], Eigen::Vector3i(0, 2, 3));
  EXPECT_EQ(mesh.triangles[2], Eigen::Vector3i(0, 3, 4));
}

TEST(OFFFile, commentsBlankLinesAndOtherLineEnds)
{
  for (const std::string end : { "\n", "\r\n" })
  {
    const meam::TriangleMesh mesh =
      read("# made by hand" + end + end + "OFF # a mesh" + end + "3 1 # no edges" + end + "0 0 0" + end + " \t" + end +
           "1 0 0 # second" + end + "0\t1 0" + end + "# faces" + end + "3 0 1 2");
    EXPECT_EQ(mesh.vertices.size(), 3u);
    EXPECT_EQ(mesh.triangles.size(), 1u);
  }
}

TEST(OFFFile, countsBehindTheFirstWord)
{
  // As in the files of ModelNet; some even without a blank, which are refused.
  EXPECT_EQ(read("OFF " + corners + "3 0 1 2\n").triangles.size(), 1u);
  expectError("OFF" + corners + "3 0 1 2\n", "not an OFF file");
}

TEST(OFFFile, colorsNormalsAndTextureAreSkipped)
{
  EXPECT_EQ(read("COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n0 1 0 0 0 0 0\n3 0 1 2 0.5 0.5 0.5\n").vertices[2],
    Eigen::Vector3f(0, 1, 0));
  EXPECT_EQ(read("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2 200 10 10\n").triangles.size(), 1u);
  EXPECT_EQ(read("STCNOFF\n" + corners + "3 0 1 2\n").triangles.size(), 1u);
}

TEST(OFFFile, pointsAndLinesHaveNoTriangles)
{
  EXPECT_TRUE(read("OFF\n2 2 0\n0 0 0\n1 0 0\n2 0 1\n1 0\n").triangles.empty());
  EXPECT_TRUE(read("OFF\n0 0 0\n").vertices.empty());
}

TEST(OFFFile, damagedFiles)
{
  expectError("", "not an OFF file");
  expectError("solid part\n", "not an OFF file");
  expectError("4OFF\n" + corners, "not an OFF file");
  expectError("OFF BINARY\n", "binary");
  expectError("OFF\n", "numbers of vertices and faces");
  expectError("OFF\n4\n", "numbers of vertices and faces");
  expectError("OFF\n-4 1 0\n", "numbers of vertices and faces");
  expectError("OFF\n" + square, "after 0 of 1 faces");
  expectError("OFF\n4 1 0\n0 0 0\n1 0 0\n                    ", "after 2 of 4 vertices");
  expectError("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "vertex 1");
  expectError("OFF\n3 1 0\n0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n", "'zero'");
  expectError("OFF\n" + corners + "3 0 1 3\n", "face 0");
  expectError("OFF\n" + corners + "3 0 1 -1\n", "face 0");
  expectError("OFF\n" + corners + "4 0 1 2\n", "cut off");
  expectError("OFF\n" + corners + "x 0 1 2\n", "number of corners");
  EXPECT_THROW(meam::readOFF("/no/such/file.off"), meam::Error);
}

TEST(OFFFile, absurdSizesAreRefusedBeforeMemoryIsTaken)
{
  expectError("OFF\n2000000000 1 0\n0 0 0\n", "room");
  expectError("OFF\n1 2000000000 0\n0 0 0\n", "room");
  expectError("OFF\n99999999999999999999 1 0\n0 0 0\n", "numbers of vertices and faces");
  expectError("OFF\n" + corners + "4000000000 0 1 2\n", "face 0");
}

TEST(OFFFile, readingCanBeStopped)
{
  const Scratch file("OFF\n" + corners + "3 0 1 2\n");
  EXPECT_THROW(meam::readOFF(file.path, [](double) { return false; }), meam::Aborted);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "io/OFFFile.h"

#include "TestFiles.h"
#include "mesh/TriangleMesh.h"

namespace
{
const files::Reader readOFF{ [](const std::string& path) { return meam::readOFF(path); } };

const std::string square = "4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
const std::string triangle = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
}

TEST(OFFFile, trianglesAndPolygons)
{
  const meam::TriangleMesh mesh =
    readOFF("OFF\n5 2 0\n0 0 0\n1.5 0 0\n+1 1e0 0\n0 1 -2.5\n0 .5 0\n3 0 1 2\n4 0 2 3 4\n");
  ASSERT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.vertices[1], Eigen::Vector3f(1.5f, 0, 0));
  EXPECT_EQ(mesh.vertices[2], Eigen::Vector3f(1, 1, 0));
  EXPECT_EQ(mesh.vertices[3], Eigen::Vector3f(0, 1, -2.5f));
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[0], Eigen::Vector3i(0, 1, 2));
  EXPECT_EQ(mesh.triangles[1], Eigen::Vector3i(4, 0, 2)); // seen along its normal it is concave
  EXPECT_EQ(mesh.triangles[2], Eigen::Vector3i(2, 3, 4));
}

TEST(OFFFile, commentsBlankLinesAndOtherLineEnds)
{
  for (const std::string end : { "\n", "\r\n" })
  {
    const meam::TriangleMesh mesh =
      readOFF("# made by hand" + end + end + "OFF # a mesh" + end + "3 1 # no edges" + end + "0 0 0" + end + " \t" +
              end + "1 0 0 # second" + end + "0\t1 0" + end + "# faces" + end + "3 0 1 2");
    EXPECT_EQ(mesh.vertices.size(), 3u);
    EXPECT_EQ(mesh.triangles.size(), 1u);
  }
}

TEST(OFFFile, countsBehindTheFirstWord)
{
  // As in the files of ModelNet, some even without a blank; Geomview's may have the numbers alone.
  for (const std::string word : { "OFF ", "OFF", "COFF", "" })
  {
    EXPECT_EQ(readOFF(word + triangle + "3 0 1 2\n").triangles.size(), 1u) << word;
  }
  readOFF.fails("OFFICE\n" + triangle, "not an OFF file");
}

TEST(OFFFile, colorsNormalsAndTextureAreSkipped)
{
  EXPECT_EQ(
    readOFF("COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n0 1 0 0 0 0 0\n3 0 1 2 0.5 0.5 0.5\n").vertices[2],
    Eigen::Vector3f(0, 1, 0));
  EXPECT_EQ(readOFF("NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2 200 10 10\n").triangles.size(), 1u);
  for (const std::string word : { "STCNOFF", "NCOFF", "off", "\xef\xbb\xbfOFF" })
  {
    EXPECT_EQ(readOFF(word + "\n" + triangle + "3 0 1 2\n\x1a").triangles.size(), 1u) << word;
  }
}

TEST(OFFFile, pointsAndLinesHaveNoTriangles)
{
  EXPECT_TRUE(readOFF("OFF\n2 2 0\n0 0 0\n1 0 0\n2 0 1\n1 0\n").triangles.empty());
  EXPECT_TRUE(readOFF("OFF\n0 0 0\n").vertices.empty());
}

TEST(OFFFile, damagedFiles)
{
  readOFF.fails("", "not an OFF file");
  readOFF.fails("solid part\n", "not an OFF file");
  readOFF.fails("4OFF\n" + triangle, "points of other dimensions");
  readOFF.fails("OFF BINARY\n", "binary");
  readOFF.fails("OFF\n", "numbers of vertices and faces");
  readOFF.fails("OFF\n4\n", "numbers of vertices and faces");
  readOFF.fails("OFF\n-4 1 0\n", "numbers of vertices and faces");
  readOFF.fails("OFF\n" + square, "after 0 of 1 faces");
  readOFF.fails("OFF\n4 1 0\n0 0 0\n1 0 0\n                    ", "after 2 of 4 vertices");
  readOFF.fails("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "vertex 1");
  readOFF.fails("OFF\n3 1 0\n0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n", "'zero'");
  readOFF.fails("OFF\n" + triangle + "3 0 1 3\n", "face 0");
  readOFF.fails("OFF\n" + triangle + "3 0 1 -1\n", "face 0");
  readOFF.fails("OFF\n" + triangle + "4 0 1 2\n", "cut off");
  readOFF.fails("OFF\n" + triangle + "x 0 1 2\n", "number of corners");
  EXPECT_THROW(meam::readOFF("/no/such/file.off"), meam::Error);
}

TEST(OFFFile, absurdSizesAreRefusedBeforeMemoryIsTaken)
{
  readOFF.fails("OFF\n2000000000 1 0\n0 0 0\n", "room");
  readOFF.fails("OFF\n1 2000000000 0\n0 0 0\n", "room");
  readOFF.fails("OFF\n99999999999999999999 1 0\n0 0 0\n", "numbers of vertices and faces");
  readOFF.fails("OFF\n" + triangle + "4000000000 0 1 2\n", "face 0");
}

TEST(OFFFile, readingCanBeStopped)
{
  const files::Folder folder;
  const std::string path = folder.write("mesh.off", "OFF\n" + triangle + "3 0 1 2\n");
  EXPECT_THROW(meam::readOFF(path, [](double) { return false; }), meam::Aborted);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "io/MeshFile.h"

#include "TestFiles.h"
#include "TestParts.h"

#include <array>
#include <sstream>

namespace
{
/// Corner by corner, whatever the order of vertices and triangles is.
std::vector<std::array<float, 9>> corners(const meam::TriangleMesh& mesh)
{
  std::vector<std::array<float, 9>> result;
  for (const Eigen::Vector3i& triangle : mesh.triangles)
  {
    // From the least corner on, in the same sense.
    std::array<Eigen::Vector3f, 3> points{ mesh.vertices[triangle[0]], mesh.vertices[triangle[1]],
      mesh.vertices[triangle[2]] };
    const auto isLess = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b)
    { return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3); };
    std::rotate(points.begin(), std::min_element(points.begin(), points.end(), isLess), points.end());
    std::array<float, 9> values;
    for (int i = 0; i < 9; ++i)
    {
      values[i] = points[i / 3][i % 3];
    }
    result.push_back(values);
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::string asciiSTL(const meam::TriangleMesh& mesh)
{
  std::ostringstream text;
  text << "solid part\n";
  for (const Eigen::Vector3i& triangle : mesh.triangles)
  {
    text << "facet normal 0 0 0\nouter loop\n";
    for (int i = 0; i < 3; ++i)
    {
      text << "vertex " << mesh.vertices[triangle[i]].transpose() << "\n";
    }
    text << "endloop\nendfacet\n";
  }
  text << "endsolid part\n";
  return text.str();
}

std::string binarySTL(const meam::TriangleMesh& mesh)
{
  std::string bytes(80, ' ');
  bytes += files::raw(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Eigen::Vector3i& triangle : mesh.triangles)
  {
    bytes += std::string(12, '\0');
    for (int i = 0; i < 9; ++i)
    {
      bytes += files::raw(mesh.vertices[triangle[i / 3]][i % 3]);
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string obj(const meam::TriangleMesh& mesh)
{
  std::ostringstream text;
  for (const auto& vertex : mesh.vertices)
  {
    text << "v " << vertex.transpose() << "\n";
  }
  for (const auto& triangle : mesh.triangles)
  {
    text << "f " << triangle[0] + 1 << " " << triangle[1] + 1 << " " << triangle[2] + 1 << "\n";
  }
  return text.str();
}

std::string header(const meam::TriangleMesh& mesh, const std::string& format)
{
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
         std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string asciiPLY(const meam::TriangleMesh& mesh)
{
  std::ostringstream text;
  text << header(mesh, "ascii");
  for (const auto& vertex : mesh.vertices)
  {
    text << vertex.transpose() << "\n";
  }
  for (const auto& triangle : mesh.triangles)
  {
    text << "3 " << triangle.transpose() << "\n";
  }
  return text.str();
}

std::string binaryPLY(const meam::TriangleMesh& mesh)
{
  std::string bytes = header(mesh, "binary_little_endian");
  for (const auto& vertex : mesh.vertices)
  {
    bytes += files::raw(vertex.x()) + files::raw(vertex.y()) + files::raw(vertex.z());
  }
  for (const auto& triangle : mesh.triangles)
  {
    bytes += '\3' + files::raw(triangle[0]) + files::raw(triangle[1]) + files::raw(triangle[2]);
  }
  return bytes;
}

std::string off(const meam::TriangleMesh& mesh)
{
  std::ostringstream text;
  text << "OFF\n" << mesh.vertices.size() << " " << mesh.triangles.size() << " 0\n";
  for (const auto& vertex : mesh.vertices)
  {
    text << vertex.transpose() << "\n";
  }
  for (const auto& triangle : mesh.triangles)
  {
    text << "3 " << triangle.transpose() << "\n";
  }
  return text.str();
}
}

TEST(MeshFile, TheSameMeshInEveryForm)
{
  const files::Folder folder;
  const meam::TriangleMesh part = parts::lBracket();
  const std::vector<std::pair<std::string, std::string>> forms = { { "text.stl", asciiSTL(part) },
    { "binary.STL", binarySTL(part) }, { "a.obj", obj(part) }, { "text.ply", asciiPLY(part) },
    { "binary.ply", binaryPLY(part) }, { "a.off", off(part) } };
  for (const auto& [name, bytes] : forms)
  {
    EXPECT_EQ(corners(meam::readMesh(folder.write(name, bytes))), corners(part)) << name;
  }
}

TEST(MeshFile, TrianglesOfAnSTLShareTheirVertices)
{
  meam::TriangleMesh mesh;
  mesh.vertices = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { -0.0f, 0, 0 } };
  mesh.triangles = { { 2, 0, 1 }, { 2, 1, 3 }, { 4, 3, 1 } };
  const files::Folder folder;
  for (const std::string& bytes : { asciiSTL(mesh), binarySTL(mesh) })
  {
    const meam::TriangleMesh found = meam::readMesh(folder.write("part.stl", bytes));
    EXPECT_EQ(found.vertices, (meam::Points{ { 0, 1, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } }));
    EXPECT_EQ(found.triangles, (std::vector<Eigen::Vector3i>{ { 0, 1, 2 }, { 0, 2, 3 }, { 1, 3, 2 } }));
  }
}

TEST(MeshFile, ASolidWordDoesNotMakeTheFileText)
{
  const files::Folder folder;
  const meam::TriangleMesh part = parts::lBracket();
  std::string bytes = binarySTL(part);
  bytes.replace(0, 10, "solid part"); // as some programs write it
  EXPECT_EQ(corners(meam::readMesh(folder.write("a.stl", bytes))), corners(part));
}

TEST(MeshFile, TrianglesThatShareAnEdgeWithTwoOthersStay)
{
  const files::Folder folder;
  meam::TriangleMesh fan;
  fan.vertices = { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { -1, 1, 0 }, { -1, -1, 0 } };
  fan.triangles = { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } };
  for (const auto& [name, bytes] :
    { std::pair("a.stl", binarySTL(fan)), std::pair("a.obj", obj(fan)), std::pair("a.ply", binaryPLY(fan)) })
  {
    EXPECT_EQ(corners(meam::readMesh(folder.write(name, bytes))), corners(fan)) << name;
  }
}

TEST(MeshFile, PolygonsBecomeTriangles)
{
  const files::Folder folder;
  const std::string path = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  EXPECT_EQ(meam::readMesh(path).triangles.size(), 2u);
}

TEST(MeshFile, ReadingTellsItsProgressAndCanBeStopped)
{
  const files::Folder folder;
  meam::TriangleMesh mesh;
  mesh.vertices = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  mesh.triangles.assign(70000, { 0, 1, 2 });
  const std::vector<std::pair<std::string, std::string>> forms = { { "text.stl", asciiSTL(mesh) },
    { "binary.stl", binarySTL(mesh) }, { "a.obj", obj(mesh) }, { "text.ply", asciiPLY(mesh) },
    { "binary.ply", binaryPLY(mesh) }, { "a.off", off(mesh) } };
  for (const auto& [name, bytes] : forms)
  {
    const std::string path = folder.write(name, bytes);
    std::vector<double> shares;
    meam::readMesh(path, [&](double share) { return shares.push_back(share), true; });
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end())) << name;
    EXPECT_EQ(shares.front(), 0.0) << name;
    EXPECT_EQ(shares.back(), 1.0) << name;
    const auto isBetween = [](double share) { return share > 0.0 && share < 1.0; };
    EXPECT_TRUE(std::any_of(shares.begin(), shares.end(), isBetween)) << name;
    EXPECT_THROW(meam::readMesh(path, [&](double share) { return !isBetween(share); }), meam::Aborted) << name;
  }
}

TEST(MeshFile, WhatIsWrongWithAFile)
{
  const files::Folder folder;
  const meam::TriangleMesh part = parts::lBracket();
  const auto errorOf = [&](const std::string& name, const std::string& bytes)
  {
    const std::string path = folder.write(name, bytes);
    const std::string error = files::errorOf([&] { meam::readMesh(path); });
    EXPECT_TRUE(files::contains(error, path)) << name << ": " << error;
    return error;
  };
  EXPECT_TRUE(files::contains(errorOf("a.vrml", "#VRML"), ".stl, .obj, .ply or .off"));
  EXPECT_TRUE(files::contains(errorOf("a.STEP", "ISO-10303-21;"), "loadCAD"));
  EXPECT_TRUE(files::contains(errorOf("a.stl", ""), "cut off"));
  EXPECT_TRUE(files::contains(errorOf("a.stl", binarySTL(part).substr(0, 500)), "cut off"));
  EXPECT_TRUE(files::contains(errorOf("a.stl", "solid part\nfacet\nendsolid part\n"), "no faces"));
  EXPECT_NE(errorOf("a.ply", "no mesh at all"), "");
  EXPECT_NE(errorOf("a.ply", asciiPLY({}) /* cannot have faces */), "");
  EXPECT_TRUE(files::contains(errorOf("a.obj", "v 0 0 0\nv 1 0 0\n"), "no faces"));
  EXPECT_NE(files::errorOf([&] { meam::readMesh(folder.path("missing.obj")); }), "");
  EXPECT_NE(files::errorOf([&] { meam::readMesh(folder.path("missing.stl")); }), "");
}

TEST(MeshFile, TextSTLInAllFormsThatAreAbout)
{
  const meam::TriangleMesh part = parts::lBracket();
  const std::string text = asciiSTL(part);
  const auto replaced = [&](const std::string& from, const std::string& to)
  {
    std::string other = text;
    for (std::size_t at = 0; (at = other.find(from, at)) != std::string::npos; at += to.size())
    {
      other.replace(at, from.size(), to);
    }
    return other;
  };
  std::string upper = text, returns = replaced("\n", "\r");
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char letter) { return std::toupper(letter); });
  const files::Folder folder;
  for (const std::string& form : { upper, replaced("solid", "Solid"), replaced("endsolid", "end solid"), returns,
         "\xef\xbb\xbf" + text, text + "\x1a", "\r\n " + text, text + "made by hand\n", replaced("\nouter", " outer"),
         replaced("\nvertex", " vertex"), replaced("endloop\nendfacet\n", "end loop end facet ") })
  {
    EXPECT_EQ(corners(meam::readMesh(folder.write("a.stl", form))), corners(part)) << form.substr(0, 20);
  }
  const auto error = [&](const std::string& form)
  { return files::errorOf([&] { meam::readMesh(folder.write("a.stl", form)); }); };
  EXPECT_TRUE(files::contains(error("solid\nfacet normal 0 0 0\nouter loop\nvertex 1,5 0 0\n"), "decimal comma"));
  // Nine corners, but no three triangles.
  const std::string corner = "vertex 0 1 2\n", two = corner + corner;
  EXPECT_TRUE(files::contains(error("solid\nouter loop\n" + two + two + "endloop\nouter loop\n" + two +
                                    "endloop\nouter loop\n" + two + corner + "endloop\nendsolid\n"),
    "has a facet of 4 corners: export it as triangles, or as OBJ"));
  EXPECT_TRUE(files::contains(error("solid\nouter loop\n" + two + "endloop\nendsolid\n"), "has a facet of 2 corners"));
}

TEST(MeshFile, CommentsOfOBJAreNotContinued)
{
  const files::Folder folder;
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n", mark = "\xef\xbb\xbf";
  for (const std::string& text : { mark + "# of C:\\parts\\\n" + points + "f 1 2 3 # \\\nf 2 3 4\n",
         points + "f 1 2 \\\n3\r\nf 2 \\\r\n3 4 # or \\ so \\\r\n" })
  {
    const meam::TriangleMesh mesh = meam::readMesh(folder.write("a.obj", text));
    EXPECT_EQ(mesh.vertices.size(), 4u) << text;
    EXPECT_EQ(mesh.triangles.size(), 2u) << text;
  }
}

TEST(MeshFile, AHeaderThatContradictsTheFileIsAnError)
{
  const files::Folder folder;
  const auto error = [&](const std::string& name, const std::string& bytes)
  { return files::errorOf([&] { meam::readMesh(folder.write(name, bytes)); }); };
  std::string stl = binarySTL(parts::lBracket());
  stl[80] = 3;
  EXPECT_TRUE(files::contains(error("a.stl", stl), "promises 3 triangles and has room for"));
  EXPECT_TRUE(files::contains(error("a.off", off(parts::lBracket()) + "3 0 1 2\n"), "goes on after"));
  EXPECT_TRUE(files::contains(error("a.ply", asciiPLY(parts::lBracket()) + "3 0 1 2\n"), "goes on after"));
  const std::string ply = binaryPLY(parts::lBracket()),
                    count = "face " + std::to_string(parts::lBracket().triangles.size());
  EXPECT_TRUE(files::contains(
    error("a.ply", std::string(ply).replace(ply.find(count), count.size(), "face 3")), "goes on after"));
  EXPECT_EQ(error("a.ply", ply + "\n"), "");
  EXPECT_TRUE(
    files::contains(error("a.ply", "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
                                   "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                   "end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n"),
      "has its faces before its points"));
}

TEST(MeshFile, FacesOfManyCornersAreCutInside)
{
  // An L, which begins at the corner that sees least of it.
  const std::string vertices[] = { "3 0 0", "3 1 0", "1 1 0", "1 3 0", "0 3 0", "0 0 0" };
  std::string obj,
    ply = "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float "
          "z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n",
    off = "OFF\n6 1 0\n";
  for (const std::string& vertex : vertices)
  {
    obj += "v " + vertex + "\n";
    ply += vertex + "\n";
    off += vertex + "\n";
  }
  const files::Folder folder;
  for (const auto& [name, bytes] : { std::pair<std::string, std::string>{ "a.obj", obj + "f 1 2 3 \\\n 4 5 6\n" },
         { "b.obj", obj + "f 1/1 2/2 3/3 \\\r\n4/4 5/5 6/6\r\n" }, { "a.ply", ply + "6 0 1 2 3 4 5\n" },
         { "a.off", off + "6 0 1 2 3 4 5\n" } })
  {
    const meam::TriangleMesh mesh = meam::readMesh(folder.write(name, bytes));
    EXPECT_EQ(mesh.triangles.size(), 4u) << name;
    double area = 0.0;
    for (const Eigen::Vector3i& t : mesh.triangles)
    {
      const Eigen::Vector3f a = mesh.vertices[t[0]];
      area += 0.5 * std::abs((mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).z());
    }
    EXPECT_NEAR(area, 5.0, 1e-6) << name;
  }
}

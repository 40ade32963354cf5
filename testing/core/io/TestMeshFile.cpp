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

using Forms = std::vector<std::pair<std::string, std::string>>;

/// The name and the bytes of a file of each form.
Forms formsOf(const meam::TriangleMesh& mesh)
{
  return { { "text.stl", asciiSTL(mesh) }, { "binary.STL", binarySTL(mesh) }, { "a.obj", obj(mesh) },
    { "text.ply", asciiPLY(mesh) }, { "binary.ply", binaryPLY(mesh) }, { "a.off", off(mesh) } };
}

meam::TriangleMesh read(const std::string& name, const std::string& bytes)
{
  const files::Folder folder;
  return meam::readMesh(folder.write(name, bytes));
}

/// What reading says; it names the file.
void expectError(const std::string& name, const std::string& bytes, const std::string& words)
{
  const std::string error = files::errorOf([&] { read(name, bytes); });
  EXPECT_TRUE(error != "" && files::contains(error, name) && files::contains(error, words)) << name << ": " << error;
}
}

TEST(MeshFile, TheSameMeshInEveryForm)
{
  const meam::TriangleMesh part = parts::lBracket();
  Forms forms = formsOf(part);
  forms.emplace_back("solid.stl", binarySTL(part).replace(0, 10, "solid part")); // as some programs write it
  for (const auto& [name, bytes] : forms)
  {
    EXPECT_EQ(corners(read(name, bytes)), corners(part)) << name;
  }
}

TEST(MeshFile, TrianglesOfAnSTLShareTheirVertices)
{
  const meam::TriangleMesh mesh{ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { -0.0f, 0, 0 } },
    { { 2, 0, 1 }, { 2, 1, 3 }, { 4, 3, 1 } } };
  for (const std::string& bytes : { asciiSTL(mesh), binarySTL(mesh) })
  {
    const meam::TriangleMesh found = read("part.stl", bytes);
    EXPECT_EQ(found.vertices, (meam::Points{ { 0, 1, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } }));
    EXPECT_EQ(found.triangles, (std::vector<Eigen::Vector3i>{ { 0, 1, 2 }, { 0, 2, 3 }, { 1, 3, 2 } }));
  }
}

TEST(MeshFile, TrianglesThatShareAnEdgeWithTwoOthersStay)
{
  const meam::TriangleMesh fan{ { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { -1, 1, 0 }, { -1, -1, 0 } },
    { { 0, 1, 2 }, { 0, 1, 3 }, { 0, 1, 4 } } };
  for (const auto& [name, bytes] : formsOf(fan))
  {
    EXPECT_EQ(corners(read(name, bytes)), corners(fan)) << name;
  }
}

TEST(MeshFile, ReadingTellsItsProgressAndCanBeStopped)
{
  const files::Folder folder;
  const meam::TriangleMesh mesh{ { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, { 70000, { 0, 1, 2 } } };
  for (const auto& [name, bytes] : formsOf(mesh))
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
  const meam::TriangleMesh part = parts::lBracket();
  const std::string corner = "vertex 0 1 2\n", two = corner + corner;
  const std::string ply = binaryPLY(part), count = "face " + std::to_string(part.triangles.size());
  const std::tuple<const char*, std::string, const char*> cases[] = { { "a.vrml", "#VRML", ".stl, .obj, .ply or .off" },
    { "a.STEP", "ISO-10303-21;", "loadCAD" }, { "a.stl", "", "cut off" },
    { "a.stl", binarySTL(part).substr(0, 500), "cut off" },
    { "a.stl", "solid part\nfacet\nendsolid part\n", "no faces" }, { "a.ply", "no mesh at all", "" },
    { "a.ply", asciiPLY({}) /* cannot have faces */, "" }, { "a.obj", "v 0 0 0\nv 1 0 0\n", "no faces" },
    { "a.stl", "solid\nfacet normal 0 0 0\nouter loop\nvertex 1,5 0 0\n", "decimal comma" },
    { "a.obj", "v 0 0 1.#QNAN\n", "has the coordinate '1.#QNAN', which is not a number" },
    { "a.obj", "v 0 3.1+e2 0\n", "has the coordinate '3.1+e2', which is not a number" },
    { "a.obj", "v 0 1\n", "is not three numbers" }, { "a.obj", "no mesh at all", "no lines of vertices" },
    { "a.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n", "but points or lines" },
    { "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ncstype bezier\nsurf 0 1 0 1 1 2 3\n", "free-form surfaces" },
    { "a.stl",
      "solid\nouter loop\n" + two + two + "endloop\nouter loop\n" + two + "endloop\nouter loop\n" + two + corner +
        "endloop\nendsolid\n", // nine corners
      "has a facet of 4 corners: export it as triangles, or as OBJ" },
    { "a.stl", "solid\nouter loop\n" + two + "endloop\nendsolid\n", "has a facet of 2 corners" },
    // A header that contradicts the file.
    { "a.stl", binarySTL(part).replace(80, 1, "\3"), "promises 3 triangles and has room for" },
    { "a.off", off(part) + "3 0 1 2\n", "goes on after" }, { "a.ply", asciiPLY(part) + "3 0 1 2\n", "goes on after" },
    { "a.ply", std::string(ply).replace(ply.find(count), count.size(), "face 3"), "goes on after" },
    { "a.ply",
      "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n"
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n",
      "has its faces before its points" } };
  for (const auto& [name, bytes, words] : cases)
  {
    expectError(name, bytes, words);
  }
  EXPECT_NO_THROW(read("a.ply", ply + "\n"));
  for (const char* missing : { "missing.obj", "missing.stl" })
  {
    EXPECT_THROW(meam::readMesh(missing), meam::Error);
  }
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
  for (const std::string& form : { upper, replaced("solid", "Solid"), replaced("endsolid", "end solid"), returns,
         "\xef\xbb\xbf" + text, text + "\x1a", "\r\n " + text, text + "made by hand\n", "# made by hand\n" + text,
         text + std::string(100, '\0'), replaced("\nouter", " outer"), replaced("\nvertex", " vertex"),
         replaced("endloop\nendfacet\n", "end loop end facet "), replaced("\n", " "),
         replaced("solid part\n", "solid a facet of a vertex\n") })
  {
    EXPECT_EQ(corners(read("a.stl", form)), corners(part)) << form.substr(0, 20);
  }
  const std::string line = replaced("\n", " ");
  EXPECT_EQ(read("a.stl", line + line).triangles.size(), 2 * part.triangles.size());
  expectError("a.stl", line + line.substr(0, line.rfind("facet normal")), "does not end with endsolid");
  std::string low = "\xff\xfe", high = "\xfe\xff"; // UTF-16
  for (const char letter : text)
  {
    low += { letter, '\0' };
    high += { '\0', letter };
  }
  EXPECT_EQ(corners(read("a.stl", low)), corners(part));
  EXPECT_EQ(corners(read("a.stl", high)), corners(part));
  EXPECT_EQ(corners(read("a.stl", binarySTL(part).replace(0, 2, "\xff\xfe"))), corners(part))
    << "a header of any bytes";
}

TEST(MeshFile, TextSTLWithoutItsEndIsReadWhenItIsClosed)
{
  const meam::TriangleMesh part = parts::lBracket();
  const std::string text = asciiSTL(part), whole = text.substr(0, text.find("endsolid"));
  EXPECT_EQ(corners(read("a.stl", whole)), corners(part));
  expectError("a.stl", whole.substr(0, whole.rfind("facet normal")), "does not end with endsolid");
  expectError("a.stl", whole.substr(0, whole.rfind("vertex")), "does not end with endsolid");
  expectError("a.stl", whole + "facet normal 0 0", "does not end with endsolid");
  expectError("a.stl", text + whole, "does not end with endsolid"); // a second solid that is cut off
}

TEST(MeshFile, TextInUTF16)
{
  const std::string text = "# M\xfcller\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::string low = "\xff\xfe", high = "\xfe\xff";
  for (const char letter : text)
  {
    low += letter + std::string(1, '\0');
    high += std::string(1, '\0') + letter;
  }
  for (const std::string& bytes : { low, high })
  {
    EXPECT_EQ(read("a.obj", bytes).triangles.size(), 1u);
  }
}

TEST(MeshFile, VerticesOfOBJAreAScan)
{
  const files::Folder folder;
  const std::string path = folder.write("points.obj", "# a scan\nv 1 2 3 0.5 0.5 0.5\nv 4 5 6\n");
  EXPECT_EQ(meam::readOBJPoints(path), (meam::Points{ { 1, 2, 3 }, { 4, 5, 6 } }));
  EXPECT_TRUE(files::contains(files::errorOf([&] { meam::readMesh(path); }), "has no faces"));
  const std::string empty = folder.write("empty.obj", "# nothing\n");
  EXPECT_TRUE(files::contains(files::errorOf([&] { meam::readOBJPoints(empty); }), "no OBJ file"));
}

TEST(MeshFile, CommentsOfOBJAreNotContinued)
{
  const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n", mark = "\xef\xbb\xbf";
  for (const std::string& text : { mark + "# of C:\\parts\\\n" + points + "f 1 2 3 # \\\nf 2 3 4\n",
         points + "f 1 2 \\\n3\r\nf 2 \\\r\n3 4 # or \\ so \\\r\n" })
  {
    const meam::TriangleMesh mesh = read("a.obj", text);
    EXPECT_EQ(mesh.vertices.size(), 4u) << text;
    EXPECT_EQ(mesh.triangles.size(), 2u) << text;
  }
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
  for (const auto& [name, bytes] : { std::pair<std::string, std::string>{ "a.obj", obj + "f 1 2 3 \\\n 4 5 6\n" },
         { "b.obj", obj + "f 1/1 2/2 3/3 \\\r\n4/4 5/5 6/6\r\n" }, { "c.obj", "F 1 2 3 4 5 6\n" + obj },
         { "d.obj", obj + "fo -6 -5 -4 -3 -2 -1\n" }, { "a.ply", ply + "6 0 1 2 3 4 5\n" },
         { "a.off", off + "6 0 1 2 3 4 5\n" } })
  {
    const meam::TriangleMesh mesh = read(name, bytes);
    EXPECT_EQ(mesh.triangles.size(), 4u) << name;
    EXPECT_NEAR(parts::area(mesh), 5.0, 1e-6) << name;
  }
  expectError("a.obj", obj + "f 1 2 7\n", "the corner '7', which does not exist");
  expectError("a.obj", "f 1 2 -1\n" + obj, "the corner '-1', which does not exist");
}

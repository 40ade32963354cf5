// SPDX-License-Identifier: BSD-3-Clause
#include "TestClosedMesh.h"
#include "base/Bounds.h"
#include "io/parsing/FileBytes.h"
#include "mesh/TriangleMesh.h"
#include "mesh/preparation/MeshPreparation.h"
#include "simulation/parts/SamplePart.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace
{
/// The mesh as a binary STL file.
std::string stl(const meam::TriangleMesh& mesh)
{
  std::string bytes = "ribbed flange, sample part of PPFMEAM, millimetres";
  bytes.resize(80, ' ');
  const auto append = [&](const void* from, std::size_t size) { bytes.append(static_cast<const char*>(from), size); };
  const std::uint32_t triangles = static_cast<std::uint32_t>(mesh.triangles.size());
  append(&triangles, 4);
  for (const auto& t : mesh.triangles)
  {
    const Eigen::Vector3f a = mesh.vertices[t[0]];
    const Eigen::Vector3f normal = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a).normalized();
    append(normal.data(), 12);
    for (const int corner : t)
    {
      append(mesh.vertices[corner].data(), 12);
    }
    append("\0\0", 2);
  }
  return bytes;
}
}

TEST(SamplePart, isClosedAndFacesOutward)
{
  const meam::TriangleMesh part = meam::makeSamplePart();
  EXPECT_LT(parts::reportOfClean(part).triangles, 5000);
  parts::expectTwoFacesAtEachEdge(part, 0.1f);
}

TEST(SamplePart, hasItsSizeAndFeatures)
{
  const meam::TriangleMesh part = meam::makeSamplePart();
  const Eigen::AlignedBox3f box = meam::bounds(part.vertices);
  EXPECT_NEAR(box.min().x(), -35.0f, 1e-4f);
  EXPECT_NEAR(box.max().x(), 45.0f, 1e-4f);
  EXPECT_NEAR(box.min().z(), 0.0f, 1e-4f);
  EXPECT_NEAR(box.max().z(), 22.0f, 1e-4f);
  // Spigot + flange with lug and holes + hub, rim and ribs, from circles; the polygons are a bit
  // smaller.
  const double pi = std::acos(-1.0);
  const auto ring = [&](double inside, double outside) { return pi * (outside * outside - inside * inside); };
  const double lug = 13 * (38.5 - 34.8) + 0.5 * pi * 6.5 * 6.5;
  const double volume = 3 * ring(14, 17) + 3 * (ring(8, 35) - 3 * pi * 4.5 * 4.5 + lug - pi * 9) + 16 * ring(8, 12) +
                        6 * (ring(32, 35) - 3 * 13) + 4 * (7 * 3 * 20 + ring(3, 5.2));
  EXPECT_NEAR(meam::prepareMesh(part).report.volume, volume, 0.015 * volume);
}

// The file in examples/data is this generator's. To write it again:
//   PPFMEAM_REGENERATE=1 meamCoreTests --gtest_filter=SamplePart.isTheFileOfTheExamples
TEST(SamplePart, isTheFileOfTheExamples)
{
  const std::string path =
    (std::filesystem::path(__FILE__).parent_path() / "../../../../examples/data/ribbed_flange.stl")
      .lexically_normal()
      .string();
  const std::string bytes = stl(meam::makeSamplePart());
  if (std::getenv("PPFMEAM_REGENERATE"))
  {
    meam::writeFile(path, bytes);
  }
  const std::string file = meam::readFile(path);
  EXPECT_LT(file.size(), 300000u);
  EXPECT_TRUE(file == bytes);
}

// SPDX-License-Identifier: BSD-3-Clause
#include "RivalScenes.h"

#include "base/Error.h"
#include "base/sequences/Sequences.h"
#include "features/NormalEstimation.h"
#include "io/MeshFile.h"
#include "io/cloud/PCDFile.h"
#include "mesh/ConvexHull.h"
#include "mesh/SurfaceSampling.h"
#include "mesh/preparation/MeshPreparation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iostream>

namespace rivals
{
namespace
{
constexpr int MostPoses = 5;
constexpr int Steps = 20;        // of ICP
constexpr double Spacing = 0.02; // of the diameter, between samples
constexpr double Reach = 0.05;   // of the diameter, of correspondences
constexpr double Fits = 0.02;    // of the diameter
constexpr double Distinct = 0.1; // of the diameter
constexpr float FacingCosine = 0.2f;

Part partOf(const std::string& path, const Eigen::Vector3d& offset)
{
  meam::MeshPreparationSettings preparation;
  preparation.offset = offset;
  const meam::TriangleMesh mesh = meam::prepareMesh(meam::readMesh(path), preparation).mesh;
  Part part;
  part.diameter = meam::diameter(mesh.vertices);
  meam::SurfaceSamplingSettings sampling;
  sampling.spacing = Spacing * part.diameter;
  part.samples = meam::sampleSurface(mesh, sampling);
  return part;
}

meam::PointCloud sceneOf(const std::string& path, double diameter)
{
  meam::PointCloud all;
  all.points = meam::readPCD(path).cloud.points;
  all = meam::finitePoints(std::move(all));
  meam::PointCloud scene = all.subset(meam::thinPoints(all.points, Spacing * diameter));
  const meam::PointGrid grid(all.points, Reach * diameter);
  std::vector<int> every(scene.size());
  for (std::size_t i = 0; i < every.size(); ++i)
  {
    every[i] = static_cast<int>(i);
  }
  meam::Sensor above;
  above.perspective = false;
  above.direction = -Eigen::Vector3d::UnitZ();
  scene.normals =
    meam::estimateNormals(scene.points, meam::PointGrid(scene.points, Reach * diameter), every, above, diameter, {});
  const std::vector<int> known = meam::indicesWhere(scene.size(), [&](int i) { return !scene.normals[i].isZero(); });
  return scene.subset(known);
}

meam::Points facing(const Part& part, const Eigen::Isometry3d& T)
{
  meam::Points visible;
  const Eigen::Matrix3f R = T.linear().cast<float>();
  for (std::size_t i = 0; i < part.samples.size(); ++i)
  {
    if ((R * part.samples.normals[i]).z() > FacingCosine)
    {
      visible.push_back(part.samples.points[i]);
    }
  }
  return visible;
}
}

Transforms refined(
  const Transforms& candidates, const Part& part, const meam::PointGrid& scene, const meam::Points& points)
{
  struct Ranked
  {
    Eigen::Isometry3d T;
    Eigen::Vector3d middle;
    double share;
  };
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const auto& point : part.samples.points)
  {
    middle += point.cast<double>() / static_cast<double>(part.samples.size());
  }
  std::vector<Ranked> ranked;
  for (Eigen::Isometry3d T : candidates)
  {
    for (int step = 0; step < Steps; ++step)
    {
      std::vector<Eigen::Vector3d> from, to;
      const Eigen::Isometry3f t = T.cast<float>();
      for (const auto& sample : facing(part, T))
      {
        const int nearest = scene.nearest(t * sample, Reach * part.diameter);
        if (nearest >= 0)
        {
          from.push_back((t * sample).cast<double>());
          to.push_back(points[nearest].cast<double>());
        }
      }
      if (from.size() < 10)
      {
        break;
      }
      const Eigen::Map<const Eigen::Matrix3Xd> a(from.front().data(), 3, static_cast<Eigen::Index>(from.size()));
      const Eigen::Map<const Eigen::Matrix3Xd> b(to.front().data(), 3, static_cast<Eigen::Index>(to.size()));
      T.matrix() = Eigen::umeyama(a, b, false) * T.matrix();
    }
    const meam::Points visible = facing(part, T);
    const Eigen::Isometry3f t = T.cast<float>();
    const auto there = std::count_if(visible.begin(), visible.end(),
      [&](const Eigen::Vector3f& sample) { return scene.nearest(t * sample, Fits * part.diameter) >= 0; });
    ranked.push_back({ T, T * middle, visible.empty() ? 0.0 : static_cast<double>(there) / visible.size() });
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) { return a.share > b.share; });
  std::vector<Ranked> kept;
  for (const Ranked& pose : ranked)
  {
    if (std::none_of(kept.begin(), kept.end(),
          [&](const Ranked& other) { return (other.middle - pose.middle).norm() < Distinct * part.diameter; }))
    {
      kept.push_back(pose);
    }
  }
  Transforms result;
  for (const Ranked& pose : kept)
  {
    result.push_back(pose.T);
  }
  return result;
}

int run(int argc, char** argv, const std::function<Finder(const Part& part, bool refined)>& train)
{
  const bool isRefined = argc > 1 && std::strcmp(argv[1], "--refined") == 0;
  const int first = isRefined ? 2 : 1;
  if (argc < first + 6 || (argc - first) % 2 != 0)
  {
    std::cerr << argv[0] << " [--refined] CAD X Y Z SCENE.pcd OUT.txt [SCENE.pcd OUT.txt ...]\n";
    return 2;
  }
  try
  {
    const Part part =
      partOf(argv[first], { std::atof(argv[first + 1]), std::atof(argv[first + 2]), std::atof(argv[first + 3]) });
    const Finder find = train(part, isRefined);
    for (int k = first + 4; k + 1 < argc; k += 2)
    {
      const std::clock_t start = std::clock();
      const Transforms poses = find(part, sceneOf(argv[k], part.diameter));
      std::cout << argv[k] << " " << static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC << std::endl;
      std::ofstream out(argv[k + 1]);
      out.precision(12);
      for (std::size_t i = 0; i < poses.size() && i < MostPoses; ++i)
      {
        for (int value = 0; value < 16; ++value)
        {
          out << poses[i].matrix()(value / 4, value % 4) << (value < 15 ? " " : "\n");
        }
      }
    }
    return 0;
  }
  catch (const std::exception& error)
  {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
}

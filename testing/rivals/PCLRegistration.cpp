// SPDX-License-Identifier: BSD-3-Clause
// PCL's PPFRegistration with the parameters of its tutorial, lengths as shares of the diameter. It returns one pose;
// with
// --refined what that pose explains is taken out of the scene and it is asked again, ten times.
#include "RivalScenes.h"
#include "base/sequences/Sequences.h"

#include <pcl/features/impl/ppf.hpp>
#include <pcl/registration/impl/ppf_registration.hpp>

#include <algorithm>
#include <cmath>

namespace
{
constexpr int Times = 10;
constexpr double AngleStep = 12.0 / 180.0 * M_PI;
constexpr double DistanceStep = 0.05; // of the diameter
constexpr double Explained = 0.03;    // of the diameter
constexpr double Leaf = 0.08;         // of the diameter: with 0.05 training takes a minute, and a scene half of one

using Cloud = pcl::PointCloud<pcl::PointNormal>;

Cloud::Ptr toPCL(const meam::PointCloud& cloud, const std::vector<int>& indices)
{
  auto result = pcl::make_shared<Cloud>();
  for (const int i : indices)
  {
    pcl::PointNormal point;
    point.getVector3fMap() = cloud.points[i];
    point.getNormalVector3fMap() = cloud.normals[i];
    result->push_back(point);
  }
  return result;
}
}

int main(int argc, char** argv)
{
  return rivals::run(argc, argv,
    [](const rivals::Part& part, bool refined) -> rivals::Finder
    {
      const Cloud::Ptr model = toPCL(part.samples, meam::thinPoints(part.samples.points, Leaf * part.diameter));
      auto features = pcl::make_shared<pcl::PointCloud<pcl::PPFSignature>>();
      pcl::PPFEstimation<pcl::PointNormal, pcl::PointNormal, pcl::PPFSignature> estimation;
      estimation.setInputCloud(model);
      estimation.setInputNormals(model);
      estimation.compute(*features);
      auto search = pcl::make_shared<pcl::PPFHashMapSearch>(
        static_cast<float>(AngleStep), static_cast<float>(DistanceStep * part.diameter));
      search->setInputFeatureCloud(features);
      return [=](const rivals::Part& of, const meam::PointCloud& scene)
      {
        rivals::Transforms found;
        std::vector<int> left = meam::thinPoints(scene.points, Leaf * of.diameter);
        for (int time = 0; time < (refined ? Times : 1) && left.size() > 10; ++time)
        {
          pcl::PPFRegistration<pcl::PointNormal, pcl::PointNormal> registration;
          registration.setSceneReferencePointSamplingRate(10);
          registration.setPositionClusteringThreshold(static_cast<float>(0.1 * of.diameter));
          registration.setRotationClusteringThreshold(static_cast<float>(15.0 / 180.0 * M_PI));
          registration.setSearchMethod(search);
          registration.setInputSource(model);
          registration.setInputTarget(toPCL(scene, left));
          Cloud aligned;
          registration.align(aligned);
          Eigen::Isometry3d T;
          T.matrix() = registration.getFinalTransformation().cast<double>();
          T.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
          found.push_back(T);
          const auto there = meam::mapped<Eigen::Vector3f>(
            of.samples.points, [&](const auto& point) -> Eigen::Vector3f { return T.cast<float>() * point; });
          const meam::PointGrid grid(there, Explained * of.diameter);
          meam::eraseIf(left, [&](int i) { return grid.nearest(scene.points[i], Explained * of.diameter) >= 0; });
        }
        return refined ? rivals::refined(found, of, meam::PointGrid(scene.points, 0.05 * of.diameter), scene.points)
                       : found;
      };
    });
}

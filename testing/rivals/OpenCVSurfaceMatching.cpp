// SPDX-License-Identifier: BSD-3-Clause
// OpenCV contrib's surface_matching with the parameters of its sample (ppf_load_match.cpp), but for the model's
// sampling, which is 5 % in place of 2.5 %: training with more points takes minutes.
#include "RivalScenes.h"

#include <opencv2/core.hpp>
#include <opencv2/surface_matching.hpp>
#include <opencv2/surface_matching/ppf_helpers.hpp>

#include <memory>

namespace
{
constexpr std::size_t AsShipped = 5; // poses that its own ICP refines
constexpr std::size_t Candidates = 100;

cv::Mat matrixOf(const meam::PointCloud& cloud)
{
  cv::Mat matrix(static_cast<int>(cloud.size()), 6, CV_32F);
  for (int i = 0; i < matrix.rows; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      matrix.at<float>(i, axis) = cloud.points[i][axis];
      matrix.at<float>(i, 3 + axis) = cloud.normals[i][axis];
    }
  }
  return matrix;
}

rivals::Transforms transformsOf(const std::vector<cv::ppf_match_3d::Pose3DPtr>& poses)
{
  rivals::Transforms transforms;
  for (const auto& pose : poses)
  {
    Eigen::Isometry3d T;
    for (int k = 0; k < 16; ++k)
    {
      T.matrix()(k / 4, k % 4) = pose->pose.val[k];
    }
    transforms.push_back(T);
  }
  return transforms;
}
}

int main(int argc, char** argv)
{
  return rivals::run(argc, argv,
    [](const rivals::Part& part, bool refined) -> rivals::Finder
    {
      const cv::Mat model = matrixOf(part.samples);
      const auto detector = std::make_shared<cv::ppf_match_3d::PPF3DDetector>(0.05, 0.05);
      detector->trainModel(model);
      return [=](const rivals::Part& of, const meam::PointCloud& scene)
      {
        const cv::Mat cloud = matrixOf(scene);
        std::vector<cv::ppf_match_3d::Pose3DPtr> found;
        detector->match(cloud, found, 1.0 / 40.0, 0.05);
        found.resize(std::min(found.size(), refined ? Candidates : AsShipped));
        if (!refined)
        {
          cv::ppf_match_3d::ICP(100, 0.005f, 2.5f, 8).registerModelToScene(model, cloud, found);
          return transformsOf(found);
        }
        return rivals::refined(
          transformsOf(found), of, meam::PointGrid(scene.points, 0.05 * of.diameter), scene.points);
      };
    });
}

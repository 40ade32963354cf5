// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Error.h"
#include "pose/Pose.h"
#include "scene/Camera.h"
#include "scene/OrganizedCloud.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace meam
{
/// An image of a dataset in the form of the BOP benchmark: SPLIT/SSSSSS/{scene_camera.json, depth/IIIIII.png,
/// rgb or gray/IIIIII.png, scene_gt.json, scene_gt_info.json}; the last three need not be there.
struct BOPImage
{
  int sceneId = 0;
  int imageId = 0;
  std::string folder;      ///< of its scene
  Camera camera;           ///< that took depth and image; without a size
  double depthScale = 1.0; ///< mm that a depth of 1 stands for
};

/// A copy of an object and where it truly is; its visible fraction is 0 where it is not known.
struct BOPInstance
{
  int objectId = 0;
  Pose pose; ///< mm, T_scene_model with the camera's frame as the scene's
};

/// The images of a dataset's split, by scene and number; or of one scene only. `path` is the folder of the
/// dataset, of a split or of a scene, or a file in one of them; `split` is looked at in the first case alone.
/// Throws Error, naming the file or folder, when there is no scene or something in it cannot be read.
std::vector<BOPImage> listBOPImages(const std::string& path, const std::string& split = "test");

/// Width and height of an image, from the header of its depth image.
std::array<int, 2> readBOPSize(const BOPImage& image);

/// What the camera measured, in its frame.
OrganizedCloud readBOPDepth(const BOPImage& image, const Progress& progress = {});

/// The colour or grey image that is registered with the depth; none when there is no such file. Throws Error when
/// it has another size than `cloud`.
std::optional<Image> readBOPColors(const BOPImage& image, const OrganizedCloud& cloud);

/// The true poses in an image, in the file's order; none when they are not known.
std::vector<BOPInstance> readBOPTruth(const BOPImage& image);
}
